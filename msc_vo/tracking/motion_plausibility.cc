// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_plausibility.h"

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
// Seconds for which the frames that follow are questioned, too: the default of
// SegmentOptions::max_search, for which a lost map is searched.
constexpr double kQuestionedSeconds = 5.0;

}  // namespace

void MotionPlausibility::Observe(double timestamp, const CameraVelocity& velocity, bool after_gap) {
  const double angular_speed = velocity.angular.norm();
  const double linear_speed = velocity.linear.norm();
  if (!after_gap) {
    angular_speed_ = std::max(angular_speed_, angular_speed);
    linear_speed_ = std::max(linear_speed_, linear_speed);
    return;
  }
  if (angular_speed > std::max(kMaxSpeedUp * angular_speed_, kPlausibleAngularSpeed) ||
      linear_speed > std::max(kMaxSpeedUp * linear_speed_, kPlausibleLinearSpeed)) {
    implausible_until_ = timestamp + kQuestionedSeconds;
  }
}

}  // namespace msc_vo
