// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/motion_limits.h"

#include <algorithm>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// A camera may be moved faster while it sees nothing, but hardly by more than this factor.
constexpr double kMaxSpeedUp = 3.0;
// Speeds that are plausible at any time, also for a camera that has been at rest: walking slowly,
// and turning round in six seconds. Lower ones question more frames and find no more wrong ones
// (docs/lab/tracking.md).
constexpr double kPlausibleLinearSpeed = 1.0;                      // metres/second
constexpr double kPlausibleAngularSpeed = DegreesToRadians(60.0);  // radians/second

}  // namespace

void MotionLimits::Observe(const CameraVelocity& velocity) {
  angular_speed_ = std::max(angular_speed_, velocity.angular.norm());
  linear_speed_ = std::max(linear_speed_, velocity.linear.norm());
}

bool MotionLimits::Allow(const CameraVelocity& velocity) const {
  return velocity.angular.norm() <=
             std::max(kMaxSpeedUp * angular_speed_, kPlausibleAngularSpeed) &&
         velocity.linear.norm() <= std::max(kMaxSpeedUp * linear_speed_, kPlausibleLinearSpeed);
}

}  // namespace msc_vo
