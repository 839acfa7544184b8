// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

/// The depths that an image shows in each cell of a coarse grid over the undistorted image.
struct DepthRanges {
  static constexpr int kColumns = 32;
  static constexpr int kRows = 24;
  /// Relative tolerance of comparisons of depth: larger than pose and depth errors.
  static constexpr double kTolerance = 0.05;

  /// 1/metres. Both are 0 where less than half of the cell has a depth.
  struct Cell {
    float min_inverse_depth = 0.0f;  ///< of the farthest surface
    float max_inverse_depth = 0.0f;  ///< of the nearest surface

    bool HasDepth() const { return min_inverse_depth > 0.0f; }
  };
  std::vector<Cell> cells;  ///< row by row; empty: unknown

  const Cell& At(int column, int row) const { return cells[row * kColumns + column]; }

  /// Width and height of a cell, pixels.
  static Eigen::Vector2d CellSize(const PinholeCamera& camera) {
    return {static_cast<double>(camera.width) / kColumns,
            static_cast<double>(camera.height) / kRows};
  }
  /// Index of the cell that contains a pixel; of the nearest cell, outside the image.
  static int CellOf(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d cell = pixel.cwiseQuotient(CellSize(camera));
    return CellIndex(cell.y(), kRows) * kColumns + CellIndex(cell.x(), kColumns);
  }
  /// Pixel in the middle of a cell.
  static Eigen::Vector2d CellCenter(const PinholeCamera& camera, int column, int row) {
    return CellSize(camera).cwiseProduct(Eigen::Vector2d(column + 0.5, row + 0.5));
  }
};

}  // namespace msc_vo
