// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/map/map.h"

namespace msc_vo {

struct ReadoutTimeEstimate {
  double readout_time = 0.0;  // seconds
  double information = 0.0;   // 1 / seconds^2, of random and common errors
};

// What two keyframes with known velocities say about the readout time of a rolling shutter: where
// one was turning otherwise than the other, or a point has moved across the rows, its time is the
// seventh unknown of their relative pose. Least squares over the points that `from` has the depth
// of and whose descriptors are found again in `to`, from `readout_time` on; robust, as some are
// wrong. None if there are less than 30.
std::optional<ReadoutTimeEstimate> EstimateReadoutTime(const Keyframe& from, const Keyframe& to,
                                                       double readout_time);

}  // namespace msc_vo
