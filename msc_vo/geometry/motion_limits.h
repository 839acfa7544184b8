// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/camera_velocity.h"

namespace msc_vo {

/// Which mean velocities a camera can have had while it was not tracked, by those that it has had
/// while it was. Images do not distinguish places that look alike, such as the sides of a box or
/// the ends of a corridor; the motion that a wrong one implies may be impossible.
class MotionLimits {
 public:
  /// Reports the mean velocity of a tracked camera over some time.
  void Observe(const CameraVelocity& velocity);

  /// Whether the camera can have moved with this mean velocity.
  bool Allow(const CameraVelocity& velocity) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [angular_speed, linear_speed] = *this;  // all members, or it does not compile
    archive(angular_speed, linear_speed);
  }

 private:
  double angular_speed_ = 0.0;  // the largest so far, radians/second
  double linear_speed_ = 0.0;   // metres/second
};

}  // namespace msc_vo
