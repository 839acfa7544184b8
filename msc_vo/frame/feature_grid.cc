// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/feature_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

// Pixels per cell: about the radius of a search by projection, so that a search visits few cells.
constexpr double kCellSize = 16.0;

}  // namespace

FeatureGrid::FeatureGrid(const PinholeCamera& camera, const std::vector<PointFeature>& points)
    : columns_(std::max(1, static_cast<int>(std::ceil(camera.width / kCellSize)))),
      rows_(std::max(1, static_cast<int>(std::ceil(camera.height / kCellSize)))),
      begins_(static_cast<size_t>(columns_) * rows_ + 1, 0),
      indices_(points.size()) {
  // Counting sort: the partial sums are the ends of the cells; filling backwards turns them into
  // their beginnings.
  const auto cell_of = [this](const PointFeature& point) {
    return RowOf(point.pixel.y()) * columns_ + ColumnOf(point.pixel.x());
  };
  for (const PointFeature& point : points) ++begins_[cell_of(point)];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  for (size_t i = points.size(); i-- > 0;) {
    indices_[--begins_[cell_of(points[i])]] = static_cast<int>(i);
  }
}

int FeatureGrid::ColumnOf(double x) const { return CellIndex(x / kCellSize, columns_); }

int FeatureGrid::RowOf(double y) const { return CellIndex(y / kCellSize, rows_); }

std::vector<int> FeatureGrid::Near(const std::vector<PointFeature>& points,
                                   const Eigen::Vector2d& pixel, double radius) const {
  std::vector<int> near;
  VisitNear(points, pixel, radius, [&near](int index) { near.push_back(index); });
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace msc_vo
