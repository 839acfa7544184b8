// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Constant-velocity motion model from the last two estimated poses, scaled with time, so that it
/// tolerates dropped frames. Time stamps are in seconds.
class MotionModel {
 public:
  /// Adds an estimated pose. `cam_from_last` is the motion since the previous one.
  void Observe(double timestamp, const Rigid3& cam_from_last);
  /// Restarts at rest: the previous frame is too old, or the motion is unknown.
  void Reset(double timestamp);

  /// Predicted motion from the last observed frame to a frame at `timestamp`.
  Rigid3 Predict(double timestamp) const;
  /// Predicted velocity at `timestamp`; std::nullopt if the motion is unknown or too old.
  std::optional<CameraVelocity> VelocityAt(double timestamp) const;

  /// Mean velocity from the last observed frame to a frame at `timestamp` that Observe() has not
  /// added yet; std::nullopt if the last observed frame is too old.
  std::optional<CameraVelocity> VelocitySince(double timestamp, const Rigid3& cam_from_last) const;
  /// Velocity at the last observed frame, interpolated between the mean velocities before and after
  /// it. Arguments and std::nullopt as for VelocitySince().
  std::optional<CameraVelocity> LastVelocity(double timestamp, const Rigid3& cam_from_last) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [last_timestamp, interval, velocity] = *this;  // all members, or it does not compile
    archive(last_timestamp, interval, velocity);
  }

 private:
  double last_timestamp_ = 0.0;
  double interval_ = 0.0;  // seconds over which velocity_ was measured; 0: at rest
  CameraVelocity velocity_;
};

/// Covariance of the motion of a hand-held camera within `seconds`, if nothing is known of it: 1
/// rad/s and 0.5 m/s, in the camera frame.
PoseCovariance CovarianceOfRest(double seconds);

}  // namespace msc_vo
