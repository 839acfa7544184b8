// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/image_grid.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Samples per cell along a segment: a cell is missed only where the segment cuts its corner.
constexpr double kSamplesPerCell = 4.0;

}  // namespace

int ImageGrid::CellOf(const Eigen::Vector2d& pixel) const {
  const double column = std::clamp(pixel.x() * columns_per_pixel_, 0.0, columns_ - 1.0);
  const double row = std::clamp(pixel.y() * rows_per_pixel_, 0.0, rows_ - 1.0);
  return static_cast<int>(row) * columns_ + static_cast<int>(column);
}

std::vector<int> ImageGrid::CellsOf(const LineSegment2& segment) const {
  const Eigen::Vector2d along = segment.end - segment.start;
  const int steps =
      1 + static_cast<int>(kSamplesPerCell * std::max(std::abs(along.x()) * columns_per_pixel_,
                                                      std::abs(along.y()) * rows_per_pixel_));
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
