// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/depth_surfaces.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Sets the nearest depth (metres) of all cells of the columns from `first` to `last`.
void SetColumns(int first, int last, double depth, DepthRanges* ranges) {
  ranges->cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
  const auto inverse = static_cast<float>(1.0 / depth);
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = first; column <= last; ++column) {
      ranges->cells[row * DepthRanges::kColumns + column] = {inverse / 2.0f, inverse};
    }
  }
}

int SurfaceAt(const DepthSurfaces& surfaces, int column) {
  return surfaces.labels[5 * DepthRanges::kColumns + column];
}

TEST(DepthSurfaces, EndAtStepsOfDepth) {
  DepthRanges ranges;
  SetColumns(0, DepthRanges::kColumns - 1, 3.0, &ranges);
  SetColumns(10, 15, 1.0, &ranges);
  const DepthSurfaces surfaces(ranges);
  EXPECT_EQ(surfaces.count, 3);  // the wall on both sides, and what is before it
  EXPECT_EQ(SurfaceAt(surfaces, 0), SurfaceAt(surfaces, 9));
  EXPECT_NE(SurfaceAt(surfaces, 9), SurfaceAt(surfaces, 10));
  EXPECT_EQ(SurfaceAt(surfaces, 10), SurfaceAt(surfaces, 15));
  EXPECT_NE(SurfaceAt(surfaces, 0), SurfaceAt(surfaces, 16));
}

TEST(DepthSurfaces, FollowSlopes) {
  DepthRanges ranges;
  for (int column = 0; column < DepthRanges::kColumns; ++column) {
    SetColumns(column, column, 2.0 + 0.05 * column, &ranges);
  }
  EXPECT_EQ(DepthSurfaces(ranges).count, 1);
}

TEST(DepthSurfaces, HaveNoCellsWithoutDepth) {
  DepthRanges ranges;
  SetColumns(4, DepthRanges::kColumns - 1, 2.0, &ranges);
  const DepthSurfaces surfaces(ranges);
  EXPECT_EQ(surfaces.count, 1);
  EXPECT_EQ(SurfaceAt(surfaces, 3), DepthSurfaces::kNone);
  EXPECT_EQ(DepthSurfaces(DepthRanges()).count, 0);
}

}  // namespace
}  // namespace msc_vo
