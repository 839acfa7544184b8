// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/image_grid.h"

#include <limits>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

// Four columns and two rows of 25 x 50 pixels.
ImageGrid FourByTwo() {
  PinholeCamera camera;
  camera.width = 100;
  camera.height = 100;
  return {4, 2, camera};
}

TEST(ImageGrid, NumbersCellsRowByRow) {
  const ImageGrid grid = FourByTwo();
  EXPECT_EQ(grid.size(), 8);
  EXPECT_EQ(grid.CellOf({10.0, 10.0}), 0);
  EXPECT_EQ(grid.CellOf({60.0, 10.0}), 2);
  EXPECT_EQ(grid.CellOf({60.0, 70.0}), 6);
  for (int cell = 0; cell < grid.size(); ++cell) {
    EXPECT_EQ(grid.CellOf(100.0 * grid.CenterOf(cell)), cell);
  }
}

TEST(ImageGrid, MapsNonFinitePixelsToAValidCell) {
  const ImageGrid grid = FourByTwo();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(grid.CellOf({nan, nan}), 0);
  EXPECT_EQ(grid.CellOf({1e300, -1e300}), 3);
  for (const int cell : grid.CellsOf({{nan, 0.0}, {1e300, 1e300}})) {
    EXPECT_GE(cell, 0);
    EXPECT_LT(cell, grid.size());
  }
}

TEST(ImageGrid, AssignsPixelsOutsideToTheNearestCell) {
  const ImageGrid grid = FourByTwo();
  EXPECT_EQ(grid.CellOf({-3.0, 20.0}), 0);
  EXPECT_EQ(grid.CellOf({102.0, 20.0}), 3);
  EXPECT_EQ(grid.CellOf({60.0, 104.0}), 6);
}

TEST(ImageGrid, ListsTheCellsOfASegment) {
  const ImageGrid grid = FourByTwo();
  EXPECT_THAT(grid.CellsOf({{90.0, 20.0}, {10.0, 20.0}}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(grid.CellsOf({{10.0, 20.0}, {10.0, 90.0}}), ElementsAre(0, 4));
  EXPECT_THAT(grid.CellsOf({{10.0, 20.0}, {12.0, 22.0}}), ElementsAre(0));
  EXPECT_EQ(grid.CellOf(LineSegment2{{90.0, 20.0}, {14.0, 20.0}}), 2);
}

}  // namespace
}  // namespace msc_vo
