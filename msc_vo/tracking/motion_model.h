// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Constant velocity between the last two estimated poses, scaled with time, so that a dropped frame
// does no harm.
class MotionModel {
 public:
  // Tells the pose of a frame. `cam_from_last` is the motion since the previous observed frame.
  void Observe(double timestamp, const Rigid3& cam_from_last);
  // Starts again at rest: the last frame was not a neighbour, or nothing is known of the motion.
  void Reset(double timestamp);

  // Motion from the last observed frame to a frame at `timestamp`.
  Rigid3 Predict(double timestamp) const;
  // At `timestamp`, if nothing changed since the last observed frame. None if nothing is known of
  // the motion, or no longer.
  std::optional<CameraVelocity> VelocityAt(double timestamp) const;

  // The two below ask before the frame at `timestamp` is told to Observe(), and know nothing of
  // what is too long after the last one. The mean since the last observed frame:
  std::optional<CameraVelocity> VelocitySince(double timestamp, const Rigid3& cam_from_last) const;
  // At the last observed frame, from the means before and after it.
  std::optional<CameraVelocity> LastVelocity(double timestamp, const Rigid3& cam_from_last) const;

 private:
  double last_timestamp_ = 0.0;
  double interval_ = 0.0;  // seconds that velocity_ is the mean of; 0: at rest
  CameraVelocity velocity_;
};

}  // namespace msc_vo
