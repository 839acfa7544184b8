// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/motion_limits.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// How a pose was found.
enum class PoseOrigin {
  kPrediction,  ///< near the prediction from the frame before
  kSearch,      ///< by the search for large motions
  kAfterGap,    ///< by relocalisation, or after frames without a pose
};

/// Marks poses after a gap as implausible, and those of the next seconds with them: the map that
/// they were found in may show another place that looks alike.
class PosePlausibility {
 public:
  /// Reports the mean velocity from the last frame with an estimated pose to the one at `timestamp`
  /// (seconds). A pose after a gap is implausible if the camera can hardly have moved so fast
  /// (MotionLimits); one that a search has found, if it moved three times faster than that. Speeds
  /// of plausible poses near their predictions tell how fast the camera moves.
  void Observe(double timestamp, const CameraVelocity& velocity, PoseOrigin origin);

  /// Marks the pose at `timestamp` for another reason: depth images contradict it, or it is weak,
  /// so that those that follow continue a guess.
  void MarkImplausible(double timestamp);

  /// Whether the pose of a frame at `timestamp` is implausible, or follows such a one within a few
  /// seconds.
  bool IsImplausible(double timestamp) const { return timestamp < implausible_until_; }

  /// Whether a pose was found implausible since the last UpdateJumpCovariance().
  bool is_marked() const { return is_marked_; }

  /// Covariance of the camera, in its frame, to be added to that of an implausible pose: the camera
  /// may be where it was predicted, at the largest jump of these seconds. The squared error of that
  /// place is the expected one of six degrees of freedom. Call it once for each pose, after the
  /// others.
  const PoseCovariance& UpdateJumpCovariance(double timestamp, const Rigid3& cam_from_last,
                                             const Rigid3& cam_from_predicted);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [limits, implausible_until, marked, jump_covariance] = *this;  // all members
    archive(limits, implausible_until, marked, jump_covariance);
  }

 private:
  MotionLimits limits_;
  double implausible_until_ = std::numeric_limits<double>::lowest();  // seconds
  bool is_marked_ = false;  // since the last UpdateJumpCovariance()
  PoseCovariance jump_covariance_ = PoseCovariance::Zero();
};

}  // namespace msc_vo
