// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_plausibility.h"

#include <algorithm>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// A camera may be moved faster while it sees nothing, but hardly by more than this factor.
constexpr double kMaxSpeedUp = 3.0;
// Speeds of a camera in the hand, which are plausible at any time: about the largest mean speeds of
// recordings of the TUM benchmark.
constexpr double kHandHeldLinearSpeed = 0.5;                      // metres/second
constexpr double kHandHeldAngularSpeed = DegreesToRadians(50.0);  // radians/second
// Seconds after which a place in which the camera goes on being tracked is believed: as long as
// a lost map is searched for at most (SegmentOptions::max_search).
constexpr double kSecondsUntilBelieved = 5.0;

}  // namespace

void MotionPlausibility::Observe(double timestamp, const CameraVelocity& velocity, bool after_gap) {
  const double angular_speed = velocity.angular.norm();
  const double linear_speed = velocity.linear.norm();
  if (!after_gap) {
    angular_speed_ = std::max(angular_speed_, angular_speed);
    linear_speed_ = std::max(linear_speed_, linear_speed);
    return;
  }
  if (angular_speed > std::max(kMaxSpeedUp * angular_speed_, kHandHeldAngularSpeed) ||
      linear_speed > std::max(kMaxSpeedUp * linear_speed_, kHandHeldLinearSpeed)) {
    implausible_until_ = timestamp + kSecondsUntilBelieved;
  }
}

}  // namespace msc_vo
