// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/search_budget.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

constexpr double kIntervalsPerSecond = 30.0;
constexpr double kMaxSeconds = 0.2;  // a gap in the recording leaves no time for a longer search
// The number of intervals is rounded from here on, so that jitter of the stamps decides nothing.
constexpr double kMinRounded = 0.75;

}  // namespace

int KeyframesToTry(int keyframes_per_interval, double seconds, size_t num_keyframes) {
  double intervals = kIntervalsPerSecond * std::min(seconds, kMaxSeconds);
  if (intervals >= kMinRounded) intervals = std::round(intervals);
  const int num_in_time = static_cast<int>(std::lround(keyframes_per_interval * intervals));
  const int num_different = std::max(keyframes_per_interval, static_cast<int>(num_keyframes));
  return std::clamp(num_in_time, 1, num_different);
}

}  // namespace msc_vo
