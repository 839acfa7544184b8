// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// A regular grid of cells over an image, numbered row by row from the upper left.
class ImageGrid {
 public:
  /// Divides the image of `camera` into `columns` x `rows` cells, both at least 1.
  ImageGrid(int columns, int rows, const PinholeCamera& camera)
      : columns_(columns),
        rows_(rows),
        columns_per_pixel_(columns / static_cast<double>(camera.width)),
        rows_per_pixel_(rows / static_cast<double>(camera.height)) {}

  /// Number of cells.
  int size() const { return columns_ * rows_; }

  /// Returns the cell that contains `pixel`. Pixels outside the image, where undistortion may move
  /// features, belong to the nearest cell.
  int CellOf(const Eigen::Vector2d& pixel) const;

  /// Returns the cell that contains the segment's midpoint.
  int CellOf(const LineSegment2& segment) const { return CellOf(segment.Midpoint()); }

  /// Returns the cells that the segment crosses, in order from its start, sampled four times per
  /// cell.
  std::vector<int> CellsOf(const LineSegment2& segment) const;

  /// Centre of a cell, as a fraction of the image's width and height.
  Eigen::Vector2d CenterOf(int cell) const {
    const int column = cell % columns_, row = cell / columns_;
    return {(column + 0.5) / columns_, (row + 0.5) / rows_};
  }

 private:
  int columns_;
  int rows_;
  double columns_per_pixel_;
  double rows_per_pixel_;
};

}  // namespace msc_vo
