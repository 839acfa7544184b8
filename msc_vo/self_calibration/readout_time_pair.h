// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/map/map.h"

namespace msc_vo {

struct ReadoutTimeEstimate {
  double readout_time = 0.0;  ///< seconds
  double information = 0.0;   ///< 1/seconds^2, of random and common errors together
};

/// Estimates the readout time of a rolling shutter from two keyframes with known velocities. The
/// readout time is observable where the angular velocities of the two differ, or where points moved
/// across the rows; it is the seventh unknown beside the relative pose. Robust least squares,
/// starting at `readout_time` (seconds), over the points of `from` that have a depth and are
/// matched by descriptor in `to`. Returns std::nullopt if there are fewer than 30 matches or a
/// velocity is unknown.
std::optional<ReadoutTimeEstimate> EstimateReadoutTime(const Keyframe& from, const Keyframe& to,
                                                       double readout_time);

}  // namespace msc_vo
