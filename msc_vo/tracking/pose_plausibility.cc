// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_plausibility.h"

namespace msc_vo {

namespace {

// Seconds for which the frames that follow are implausible, too: the default of
// SegmentOptions::max_search, for which a lost map is searched.
constexpr double kImplausibleSeconds = 5.0;

}  // namespace

void PosePlausibility::Observe(double timestamp, const CameraVelocity& velocity, bool after_gap) {
  if (!after_gap) {
    if (!IsImplausible(timestamp)) limits_.Observe(velocity);
  } else if (!limits_.Allow(velocity)) {
    MarkImplausible(timestamp);
  }
}

void PosePlausibility::MarkImplausible(double timestamp) {
  implausible_until_ = timestamp + kImplausibleSeconds;
}

}  // namespace msc_vo
