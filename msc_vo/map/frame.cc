// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/frame.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace msc_vo {

namespace {

// Pixels per bucket: about the radius of a search by projection, so that one looks into few cells.
constexpr double kCellSize = 16.0;

}  // namespace

int HammingDistance(const Descriptor& a, const Descriptor& b) {
  int distance = 0;
  for (size_t i = 0; i < a.size(); i += sizeof(uint64_t)) {
    uint64_t x = 0;
    uint64_t y = 0;
    std::memcpy(&x, &a[i], sizeof(x));
    std::memcpy(&y, &b[i], sizeof(y));
    distance += __builtin_popcountll(x ^ y);
  }
  return distance;
}

FeatureGrid::FeatureGrid(const PinholeCamera& camera, const std::vector<PointFeature>& points)
    : columns_(std::max(1, static_cast<int>(std::ceil(camera.width / kCellSize)))),
      rows_(std::max(1, static_cast<int>(std::ceil(camera.height / kCellSize)))),
      cells_(static_cast<size_t>(columns_) * rows_) {
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d& pixel = points[i].pixel;
    cells_[RowOf(pixel.y()) * columns_ + ColumnOf(pixel.x())].push_back(static_cast<int>(i));
  }
}

int FeatureGrid::ColumnOf(double x) const {
  return static_cast<int>(std::clamp(std::floor(x / kCellSize), 0.0, columns_ - 1.0));
}

int FeatureGrid::RowOf(double y) const {
  return static_cast<int>(std::clamp(std::floor(y / kCellSize), 0.0, rows_ - 1.0));
}

std::vector<int> FeatureGrid::Near(const std::vector<PointFeature>& points,
                                   const Eigen::Vector2d& pixel, double radius) const {
  std::vector<int> near;
  if (cells_.empty()) return near;
  for (int row = RowOf(pixel.y() - radius); row <= RowOf(pixel.y() + radius); ++row) {
    for (int column = ColumnOf(pixel.x() - radius); column <= ColumnOf(pixel.x() + radius);
         ++column) {
      for (const int index : cells_[row * columns_ + column]) {
        if ((points[index].pixel - pixel).squaredNorm() <= radius * radius) near.push_back(index);
      }
    }
  }
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace msc_vo
