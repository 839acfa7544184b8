// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/free_space.h"

#include <algorithm>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

// Of depth: more than what poses and depth images of a right match are off by.
constexpr double kTolerance = 0.05;

// Largest inverse depth in the four cells around a pixel; 0 if the image does not contain them, or
// one of them has no depth.
double NearestAround(const Frame& frame, const Eigen::Vector2d& pixel) {
  const double x = pixel.x() * DepthRanges::kColumns / frame.camera.width - 0.5;
  const double y = pixel.y() * DepthRanges::kRows / frame.camera.height - 0.5;
  if (!(x >= 0.0 && y >= 0.0 && x < DepthRanges::kColumns - 1 && y < DepthRanges::kRows - 1)) {
    return 0.0;
  }
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  float nearest = 0.0f;
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      const DepthRanges::Cell& cell = frame.depth_ranges.At(column + dx, row + dy);
      if (!cell.HasDepth()) return 0.0;
      nearest = std::max(nearest, cell.nearest);
    }
  }
  return nearest;
}

// Cells of `a` that `b` looks through.
int NumLookedThrough(const Frame& a, const Frame& b, const Rigid3& b_from_a) {
  const double cell_width = static_cast<double>(a.camera.width) / DepthRanges::kColumns;
  const double cell_height = static_cast<double>(a.camera.height) / DepthRanges::kRows;
  int number = 0;
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const DepthRanges::Cell& cell = a.depth_ranges.At(column, row);
      if (!cell.HasDepth()) continue;
      const Eigen::Vector2d pixel((column + 0.5) * cell_width, (row + 0.5) * cell_height);
      const Eigen::Vector3d in_b = b_from_a * a.camera.BackProject(pixel, 1.0 / cell.farthest);
      if (!IsInFront(in_b)) continue;
      const double nearest = NearestAround(b, b.camera.Project(in_b));
      if (nearest > 0.0 && nearest * (1.0 + kTolerance) < 1.0 / in_b.z()) ++number;
    }
  }
  return number;
}

}  // namespace

int NumFreeSpaceViolations(const Frame& a, const Frame& b, const Rigid3& b_from_a) {
  if (a.depth_ranges.cells.empty() || b.depth_ranges.cells.empty()) return 0;
  return std::max(NumLookedThrough(a, b, b_from_a), NumLookedThrough(b, a, b_from_a.Inverse()));
}

}  // namespace msc_vo
