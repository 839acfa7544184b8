// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/frame/depth_ranges.h"

namespace msc_vo {

/// The connected surfaces that an image shows: neighbouring cells whose nearest depths differ by at
/// most 5 % belong to the same one. What recedes faster, as a floor at a grazing angle, falls
/// apart.
struct DepthSurfaces {
  static constexpr int kNone = -1;

  explicit DepthSurfaces(const DepthRanges& ranges);

  std::vector<int> labels;  ///< of the cells, row by row, 0 to count - 1; kNone: no depth
  int count = 0;
};

}  // namespace msc_vo
