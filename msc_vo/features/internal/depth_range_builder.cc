// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_range_builder.h"

#include <algorithm>
#include <limits>

namespace msc_vo {

namespace {

// Every second pixel of the rectangle around a pixel.
DepthRanges::Cell RangeAround(const InverseDepthImage& depth, const Eigen::Vector2i& pixel,
                              const Eigen::Vector2i& half_size) {
  constexpr int kStep = 2;
  float min = std::numeric_limits<float>::max(), max = 0.0f;
  int num_pixels = 0, num_depths = 0;
  const Eigen::Vector2i first = pixel - half_size, last = pixel + half_size;
  for (int v = first.y(); v <= last.y(); v += kStep) {
    for (int u = first.x(); u <= last.x(); u += kStep) {
      ++num_pixels;
      const float inverse_depth = static_cast<float>(depth.At(u, v));
      if (!(inverse_depth > 0.0f)) continue;
      ++num_depths;
      min = std::min(min, inverse_depth);
      max = std::max(max, inverse_depth);
    }
  }
  if (2 * num_depths < num_pixels) return {};
  return {min, max};
}

}  // namespace

DepthRanges MakeDepthRanges(const InverseDepthImage& depth, const LensRemap& lens,
                            const PinholeCamera& camera) {
  const Eigen::Vector2i half_size = (0.5 * DepthRanges::CellSize(camera)).cast<int>();
  DepthRanges ranges;
  ranges.cells.reserve(DepthRanges::kColumns * DepthRanges::kRows);
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const Eigen::Vector2d raw = lens.RawFromIdeal(DepthRanges::CellCenter(camera, column, row));
      ranges.cells.push_back(depth.Contains(raw) ? RangeAround(depth, raw.cast<int>(), half_size)
                                                 : DepthRanges::Cell());
    }
  }
  return ranges;
}

}  // namespace msc_vo
