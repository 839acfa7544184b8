// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/frame/point_feature.h"

namespace msc_vo {

/// Feature indices in square cells over the image, for radius searches in time proportional to the
/// result. Points outside the image, where undistortion may move them, belong to the nearest cell.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const PinholeCamera& camera, const std::vector<PointFeature>& points);

  /// Indices of the points within `radius` pixels of `pixel`, ascending.
  std::vector<int> Near(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                        double radius) const;
  /// Calls visit(index) for each of these points without allocating; the order depends on the
  /// features alone.
  template <typename Visit>
  void VisitNear(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                 double radius, const Visit& visit) const {
    if (begins_.empty()) return;
    const int first = ColumnOf(pixel.x() - radius);
    const int last = ColumnOf(pixel.x() + radius);
    for (int row = RowOf(pixel.y() - radius); row <= RowOf(pixel.y() + radius); ++row) {
      // The cells of a row are contiguous.
      const int end = begins_[row * columns_ + last + 1];
      for (int i = begins_[row * columns_ + first]; i < end; ++i) {
        const int index = indices_[i];
        if ((points[index].pixel - pixel).squaredNorm() <= radius * radius) visit(index);
      }
    }
  }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [columns, rows, begins, indices] = *this;  // all members, or it does not compile
    archive(columns, rows, begins, indices);
  }

 private:
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> begins_;   // offset of each cell in indices_; last: their number
  std::vector<int> indices_;  // cell by cell, ascending within each
};

}  // namespace msc_vo
