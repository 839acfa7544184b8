// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

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
  kMirrored,         ///< images mirrored left to right, or a left-handed world
};
constexpr int kNumPoseConventions = 5;

const char* Describe(PoseConvention convention);

/// Pose at a time, interpolated; std::nullopt outside of the trajectory and in gaps of more than
/// 0.3 seconds. `poses` must be in order of time.
std::optional<Rigid3> InterpolatePose(const std::vector<TimedPose>& poses, double timestamp);

/// Poses of the file as they would have to be read under a convention. Mirroring is left to
/// CompareMotions().
std::vector<TimedPose> ReadAs(PoseConvention convention, std::vector<TimedPose> poses);

/// Compares the pairs of images with the ground truth `offset` seconds later.
std::vector<MotionComparison> CompareMotions(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             PoseConvention convention, double offset);

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
};

/// Fits scale and offset, given the rotation. `comparisons` must not be empty. The offset is zero
/// with standard deviation `offset_prior` (metres) beforehand.
HandEye FitHandEye(const std::vector<MotionComparison>& comparisons,
                   const Eigen::Matrix3d& camera_from_body, double offset_prior);

}  // namespace msc_vo
