// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/image_grid.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

int ImageGrid::CellOf(const Eigen::Vector2d& pixel) const {
  const double column = std::clamp(pixel.x() * per_pixel_x_, 0.0, columns_ - 1.0);
  const double row = std::clamp(pixel.y() * per_pixel_y_, 0.0, rows_ - 1.0);
  return static_cast<int>(row) * columns_ + static_cast<int>(column);
}

std::vector<int> ImageGrid::CellsOf(const LineSegment2& segment) const {
  const Eigen::Vector2d along = segment.end - segment.start;
  const int steps = 1 + static_cast<int>(4.0 * std::max(std::abs(along.x()) * per_pixel_x_,
                                                        std::abs(along.y()) * per_pixel_y_));
  std::vector<int> parts;
  parts.reserve(steps + 1);
  for (int k = 0; k <= steps; ++k) {
    // A straight line does not come back to a part that it has left.
    const int part = CellOf(segment.start + static_cast<double>(k) / steps * along);
    if (parts.empty() || parts.back() != part) parts.push_back(part);
  }
  return parts;
}

}  // namespace msc_vo
