// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/feature_grid.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(FeatureGrid, AcceptsNonFinitePixels) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<PointFeature> points(5);
  points[0].pixel = {nan, nan};
  points[1].pixel = {inf, -inf};
  points[2].pixel = {1e300, nan};
  points[3].pixel = {-inf, 1e300};
  points[4].pixel = {100.0, 100.0};
  const FeatureGrid grid(PinholeCamera(), points);
  EXPECT_THAT(grid.Near(points, {101.0, 100.0}, 5.0), ::testing::ElementsAre(4));
  EXPECT_TRUE(grid.Near(points, {nan, 100.0}, 5.0).empty());
  EXPECT_TRUE(grid.Near(points, {inf, -inf}, 5.0).empty());
  EXPECT_TRUE(grid.Near(points, {100.0, 100.0}, nan).empty());
}

TEST(FeatureGrid, MatchesExhaustiveSearch) {
  const PinholeCamera camera;
  std::mt19937 random(7);
  std::vector<PointFeature> points(500);
  for (PointFeature& point : points) {
    // Some lie outside the image, where undistortion may move them.
    point.pixel = {random() % 700 - 30.0, random() % 540 - 30.0};
  }
  const FeatureGrid grid(camera, points);
  for (const Eigen::Vector2d& center :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(320.5, 240.2), Eigen::Vector2d(660, 500)}) {
    for (const double radius : {3.0, 25.0, 120.0}) {
      std::vector<int> expected;
      for (size_t i = 0; i < points.size(); ++i) {
        if ((points[i].pixel - center).norm() <= radius) expected.push_back(static_cast<int>(i));
      }
      EXPECT_EQ(grid.Near(points, center, radius), expected) << center.transpose() << " " << radius;
    }
  }
}

TEST(FeatureGrid, FindsNothingIfEmpty) {
  EXPECT_TRUE(FeatureGrid().Near({}, {10, 10}, 100).empty());
}

}  // namespace
}  // namespace msc_vo
