// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/frame.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(HammingDistance, CountsDifferingBits) {
  Descriptor a{};
  Descriptor b{};
  EXPECT_EQ(HammingDistance(a, b), 0);
  b[0] = 0x01;
  b[31] = 0x80;
  EXPECT_EQ(HammingDistance(a, b), 2);
  a.fill(0xff);
  b.fill(0x00);
  EXPECT_EQ(HammingDistance(a, b), 256);
}

TEST(HammingDistance, MatchesBitwiseCount) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    Descriptor a;
    Descriptor b;
    int expected = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      a[k] = static_cast<uint8_t>(random());
      b[k] = static_cast<uint8_t>(random());
      for (int bit = 0; bit < 8; ++bit) expected += ((a[k] ^ b[k]) >> bit) & 1;
    }
    EXPECT_EQ(HammingDistance(a, b), expected);
  }
}

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

TEST(Frame, BackProjectsPointsAndLines) {
  Frame frame;
  PointFeature point;
  point.pixel = {frame.camera.cx + 105.0, frame.camera.cy};
  point.inverse_depth = 0.5;
  frame.points = {point};
  EXPECT_TRUE(frame.PointInCamera(0).isApprox(Eigen::Vector3d(0.4, 0.0, 2.0), 1e-12));

  LineFeature line;
  line.segment.start = frame.camera.Project({-1.0, 0.2, 2.0});
  line.segment.end = frame.camera.Project({1.0, 0.2, 4.0});
  LineDepth depth;
  depth.start = 0.5;
  depth.end = 0.25;
  line.depth = depth;
  frame.lines = {line};
  const LineSegment3 segment = frame.LineInCamera(0);
  EXPECT_TRUE(segment.start.isApprox(Eigen::Vector3d(-1.0, 0.2, 2.0), 1e-12));
  EXPECT_TRUE(segment.end.isApprox(Eigen::Vector3d(1.0, 0.2, 4.0), 1e-12));
}

}  // namespace
}  // namespace msc_vo
