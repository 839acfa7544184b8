// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// The depths that an image shows in each cell of a coarse grid over the undistorted image.
struct DepthRanges {
  static constexpr int kColumns = 32;
  static constexpr int kRows = 24;

  /// Inverse depths, 1/metres. Both are 0 where less than half of the cell has a depth.
  struct Cell {
    float nearest = 0.0f;
    float farthest = 0.0f;  ///< <= nearest

    bool HasDepth() const { return farthest > 0.0f; }

    template <typename Archive>
    void Serialize(Archive& archive) {
      archive.Fields(*this, nearest, farthest);
    }
  };
  std::vector<Cell> cells;  ///< row by row; empty: unknown

  const Cell& At(int column, int row) const { return cells[row * kColumns + column]; }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, cells);
  }
};

}  // namespace msc_vo
