// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_range_builder.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Every second pixel of the rectangle around a pixel.
DepthRanges::Cell RangeAround(const InverseDepthImage& depth, int x, int y, int half_width,
                              int half_height) {
  constexpr int kStep = 2;
  float nearest = 0.0f, farthest = 1e9f;
  int num_pixels = 0, num_depths = 0;
  for (int v = y - half_height; v <= y + half_height; v += kStep) {
    for (int u = x - half_width; u <= x + half_width; u += kStep) {
      ++num_pixels;
      const float inverse_depth = static_cast<float>(depth.At(u, v));
      if (!(inverse_depth > 0.0f)) continue;
      ++num_depths;
      nearest = std::max(nearest, inverse_depth);
      farthest = std::min(farthest, inverse_depth);
    }
  }
  if (2 * num_depths < num_pixels) return {};
  return {nearest, farthest};
}

}  // namespace

DepthRanges MakeDepthRanges(const InverseDepthImage& depth, const LensRemap& lens,
                            const PinholeCamera& camera) {
  const double cell_width = static_cast<double>(camera.width) / DepthRanges::kColumns;
  const double cell_height = static_cast<double>(camera.height) / DepthRanges::kRows;
  DepthRanges ranges;
  ranges.cells.reserve(DepthRanges::kColumns * DepthRanges::kRows);
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const Eigen::Vector2d raw =
          lens.RawFromIdeal({(column + 0.5) * cell_width, (row + 0.5) * cell_height});
      if (!depth.Contains(raw)) {
        ranges.cells.emplace_back();
        continue;
      }
      ranges.cells.push_back(
          RangeAround(depth, static_cast<int>(raw.x()), static_cast<int>(raw.y()),
                      static_cast<int>(0.5 * cell_width), static_cast<int>(0.5 * cell_height)));
    }
  }
  return ranges;
}

}  // namespace msc_vo
