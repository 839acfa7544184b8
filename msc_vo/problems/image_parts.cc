// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/image_parts.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

// Along a line, four to each part of the image that it crosses: no line in an image needs as many.
constexpr int kMaxSteps = 1 << 16;

}  // namespace

int ImageParts::PartOf(const Eigen::Vector2d& pixel) const {
  return CellIndex(pixel.y() * per_pixel_y_, rows_) * columns_ +
         CellIndex(pixel.x() * per_pixel_x_, columns_);
}

std::vector<int> ImageParts::PartsOf(const LineSegment2& segment) const {
  const Eigen::Vector2d along = segment.end - segment.start;
  const int steps = 1 + CellIndex(4.0 * std::max(std::abs(along.x()) * per_pixel_x_,
                                                 std::abs(along.y()) * per_pixel_y_),
                                  kMaxSteps);
  std::vector<int> parts;
  parts.reserve(steps + 1);
  for (int k = 0; k <= steps; ++k) {
    // A straight line does not come back to a part that it has left.
    const int part = PartOf(segment.start + static_cast<double>(k) / steps * along);
    if (parts.empty() || parts.back() != part) parts.push_back(part);
  }
  return parts;
}

}  // namespace msc_vo
