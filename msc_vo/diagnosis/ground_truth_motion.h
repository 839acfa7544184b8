// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Standard deviations from which an estimate is significant.
constexpr double kSignificantSigmas = 4.0;

/// A relative motion from the images and the same from the ground truth. Rotations are rotation
/// vectors (radians), both map coordinates of the earlier camera to the later one.
struct MotionComparison {
  Eigen::Vector3d image_rotation;
  Eigen::Vector3d image_translation;  ///< metres
  Eigen::Vector3d true_rotation;
  Eigen::Vector3d true_translation;  ///< metres
};

/// Ways in which a file of ground truth may differ from camera-in-world poses.
enum class PoseConvention {
  kCameraInWorld,    ///< as it should be
  kWorldInCamera,    ///< inverse poses
  kInverseRotation,  ///< position of the camera, but rotation from world to camera
  kScalarFirst,      ///< quaternions as w x y z
};
constexpr int kNumPoseConventions = 4;

const char* Describe(PoseConvention convention);

/// Pose at a time, interpolated; std::nullopt outside of the trajectory and in gaps of more than
/// 0.3 seconds. `poses` must be in order of time.
std::optional<Rigid3> InterpolatePose(const std::vector<TimedPose>& poses, double timestamp);

/// Poses of the file as they would have to be read under a convention.
std::vector<TimedPose> ReadAs(PoseConvention convention, std::vector<TimedPose> poses);

/// Compares the pairs of images with the ground truth `offset` seconds later.
std::vector<MotionComparison> CompareMotions(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth, double offset);

/// Median length of the translations of the ground truth, metres. `comparisons` must not be empty.
double MedianTranslation(const std::vector<MotionComparison>& comparisons);

/// Median difference of the rotation vectors over the median rotation of the images, after the
/// constant rotation `camera_from_body` has been applied to those of the ground truth.
double RotationDisagreement(const std::vector<MotionComparison>& comparisons,
                            const Eigen::Matrix3d& camera_from_body);

/// The rotation between the camera and the body whose poses the ground truth gives (hand-eye
/// rotation) that fits best.
Eigen::Matrix3d FitBodyRotation(const std::vector<MotionComparison>& comparisons);

/// Scale of the images' translations and offset of the body (hand-eye calibration).
struct HandEye {
  double scale = 1.0;  ///< true length over length from depth
  double scale_sigma = 0.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< metres, body origin in the camera frame
  double offset_sigma = 0.0;
  double correlation = 0.0;  ///< of the translations after the fit, -1..1

  bool HasScale() const;   ///< whether the motion determines the scale
  bool HasOffset() const;  ///< whether the offset is significant
};

/// Fits scale and offset, given the axes of the body in the camera, which are orthogonal and may be
/// left-handed. `comparisons` must not be empty.
HandEye FitHandEye(const std::vector<MotionComparison>& comparisons,
                   const Eigen::Matrix3d& camera_from_body);

/// The same fit if its offset is significant, or without an offset. Turning about a near point
/// resembles a translation: an offset that is not significant must neither blur the scale nor
/// explain wrong positions.
HandEye FitSignificantHandEye(const std::vector<MotionComparison>& comparisons,
                              const Eigen::Matrix3d& camera_from_body);

/// Time offset of two trajectories.
struct TimeOffset {
  double seconds = 0.0;
  double sigma = 0.0;
  double disagreement = 0.0;  ///< median rotation error at the offset over the median rotation
};

/// Time by which the ground truth must be read later than the images say, from the rotations over
/// about a tenth of a second, within +-`reach` seconds. `truth` holds camera-in-world poses of a
/// body that `camera_from_body` turns into the camera. Returns std::nullopt if the camera rotates
/// too little.
std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const Eigen::Matrix3d& camera_from_body, double reach);

}  // namespace msc_vo
