// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/ground_truth_motion.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Disagreement of rotations up to which ground truth and images belong together.
constexpr double kMaxDisagreement = 0.35;
/// Correlation of translations from which positions agree.
constexpr double kMinCorrelation = 0.6;
/// Pairs of images that a comparison needs.
constexpr size_t kMinPairs = 8;
constexpr double kMinTranslation = 0.03;  ///< metres, median of the pairs

constexpr double kTimeOffsetReach = 0.5;  ///< seconds, of the search for a time offset

/// How the ground truth may be read.
struct TruthReading {
  PoseConvention convention = PoseConvention::kCameraInWorld;
  /// Rotates the axes of the body whose poses the ground truth gives into those of the camera.
  Eigen::Matrix3d camera_from_body = Eigen::Matrix3d::Identity();
  /// The images, or the world of the ground truth, are mirrored. Rotations cannot show it:
  /// mirroring along an axis changes them in the same way as a half turn about it.
  bool is_mirrored = false;
  double offset = 0.0;                ///< seconds, of the ground truth after the images
  double disagreement = 1e9;          ///< of the rotations (RotationDisagreement())
  std::optional<double> correlation;  ///< of the translations, unless the camera moves too little

  /// Axes of the body in the camera, left-handed if mirrored.
  Eigen::Matrix3d Axes() const { return is_mirrored ? -camera_from_body : camera_from_body; }
};

/// Compares the pairs of images with the ground truth as it is read.
std::vector<MotionComparison> CompareMotions(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const TruthReading& reading);

/// Time offset of the ground truth within +-0.5 s, see EstimateTimeOffset().
std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const TruthReading& reading);

/// Whether a time offset is significant, and larger than errors of the stamps.
bool IsSignificant(const TimeOffset& offset);

struct TruthReadings {
  TruthReading given;  ///< as camera-in-world poses
  TruthReading best;   ///< the same, unless another reading agrees clearly better
};

/// Finds the reading of the ground truth that agrees best with the motion of the images, among all
/// conventions with the axes of the camera, of another body, and of a mirrored one.
TruthReadings FindReading(const MotionTrack& track, const std::vector<TimedPose>& truth);

/// What the ground truth holds if it must be read in another way than the given one, and how to
/// mend that.
struct ReadingDescription {
  std::string text;
  std::string fix;
};

ReadingDescription DescribeReading(const TruthReading& reading);

}  // namespace msc_vo
