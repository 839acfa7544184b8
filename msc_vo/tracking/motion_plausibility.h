// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>

#include "msc_vo/geometry/camera_velocity.h"

namespace msc_vo {

/// Tells poses after a gap that the camera can hardly have reached in that time. One image does not
/// distinguish places that look alike, such as the sides of a box: a pose that implies a much
/// faster motion than before may be at the wrong one.
class MotionPlausibility {
 public:
  /// Reports the mean velocity from the last frame with an estimated pose to the one at `timestamp`
  /// (seconds). `after_gap`: there are frames without a pose between both.
  void Observe(double timestamp, const CameraVelocity& velocity, bool after_gap);

  /// Whether the pose of a frame at `timestamp` follows an implausible one within a few seconds.
  bool IsQuestioned(double timestamp) const { return timestamp < implausible_until_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [angular_speed, linear_speed, implausible_until] = *this;  // all, or it does not compile
    archive(angular_speed, linear_speed, implausible_until);
  }

 private:
  double angular_speed_ = 0.0;  // the largest so far, radians/second
  double linear_speed_ = 0.0;   // metres/second
  double implausible_until_ = std::numeric_limits<double>::lowest();  // seconds
};

}  // namespace msc_vo
