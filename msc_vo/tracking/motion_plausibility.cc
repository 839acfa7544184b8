// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_plausibility.h"

namespace msc_vo {

namespace {

// Seconds for which the frames that follow are questioned, too: the default of
// SegmentOptions::max_search, for which a lost map is searched.
constexpr double kQuestionedSeconds = 5.0;

}  // namespace

void MotionPlausibility::Observe(double timestamp, const CameraVelocity& velocity, bool after_gap) {
  if (!after_gap) {
    limits_.Observe(velocity);
  } else if (!limits_.Allow(velocity)) {
    Question(timestamp);
  }
}

void MotionPlausibility::Question(double timestamp) {
  questioned_until_ = timestamp + kQuestionedSeconds;
}

}  // namespace msc_vo
