// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/image_grid.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

// Samples per cell along a segment: a cell is missed only where the segment cuts its corner.
constexpr double kSamplesPerCell = 4.0;
// Bound of the samples per segment, more than any segment within an image needs.
constexpr int kMaxSamples = 1 << 16;

}  // namespace

int ImageGrid::CellOf(const Eigen::Vector2d& pixel) const {
  return CellIndex(pixel.y() * rows_per_pixel_, rows_) * columns_ +
         CellIndex(pixel.x() * columns_per_pixel_, columns_);
}

std::vector<int> ImageGrid::CellsOf(const LineSegment2& segment) const {
  const Eigen::Vector2d along = segment.end - segment.start;
  const int steps =
      1 + CellIndex(kSamplesPerCell * std::max(std::abs(along.x()) * columns_per_pixel_,
                                               std::abs(along.y()) * rows_per_pixel_),
                    kMaxSamples);
  std::vector<int> cells;
  cells.reserve(steps + 1);
  for (int k = 0; k <= steps; ++k) {
    // A straight line does not return to a cell that it has left.
    const int cell = CellOf(segment.start + static_cast<double>(k) / steps * along);
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);
  }
  return cells;
}

}  // namespace msc_vo
