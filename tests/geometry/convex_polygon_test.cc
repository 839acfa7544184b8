// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/convex_polygon.h"

#include <cmath>
#include <random>

#include "tests/support/polygon_area.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

const ConvexPolygon kSquare{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

ConvexPolygon Moved(const Vector2d& offset) {
  ConvexPolygon moved = kSquare;
  for (Vector2d& vertex : moved) vertex += offset;
  return moved;
}

ConvexPolygon Circle(int num_vertices) {
  ConvexPolygon circle;
  for (int i = 0; i < num_vertices; ++i) {
    const double angle = 2.0 * kPi * i / num_vertices;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  return circle;
}

TEST(ConvexHull, OfASquareHasItsCornersOnly) {
  std::vector<Vector2d> points;
  for (int y = 0; y <= 4; ++y) {
    for (int x = 0; x <= 4; ++x) points.emplace_back(0.25 * x, 0.25 * y);
  }
  EXPECT_EQ(ConvexHull(points), kSquare);
}

TEST(ConvexHull, ContainsAllPoints) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vector2d> points(200);
  for (Vector2d& point : points) point = {normal(random), normal(random)};
  const ConvexPolygon hull = ConvexHull(points);
  const double area = Area(hull);
  for (const Vector2d& point : points) {
    ConvexPolygon with = hull;
    with.push_back(point);
    EXPECT_NEAR(Area(ConvexHull(with)), area, 1e-12);
  }
}

TEST(ConvexHull, OfALineIsEmpty) {
  EXPECT_TRUE(ConvexHull({}).empty());
  EXPECT_TRUE(ConvexHull({{1.0, 1.0}}).empty());
  EXPECT_TRUE(ConvexHull({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}).empty());
  EXPECT_TRUE(ConvexHull({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}).empty());
}

TEST(Area, IsThatOfPolygons) {
  EXPECT_DOUBLE_EQ(Area(kSquare), 1.0);
  EXPECT_DOUBLE_EQ(Area({}), 0.0);
  EXPECT_NEAR(Area(Circle(1000)), kPi, 1e-4);
}

TEST(Simplify, LosesLittleArea) {
  ConvexPolygon circle = Circle(64);
  Simplify(16, &circle);
  EXPECT_EQ(circle.size(), 16u);
  EXPECT_NEAR(Area(circle), Area(Circle(16)), 0.02);
  ConvexPolygon square = kSquare;
  square.insert(square.begin() + 1, Vector2d(0.5, -0.01));
  Simplify(4, &square);
  EXPECT_EQ(square, kSquare);
}

TEST(AreTouching, DependsOnTheGap) {
  EXPECT_TRUE(AreTouching(kSquare, Moved({0.5, 0.5}), 0.0));
  EXPECT_TRUE(AreTouching(kSquare, Moved({1.1, 0.0}), 0.11));
  EXPECT_FALSE(AreTouching(kSquare, Moved({1.1, 0.0}), 0.09));
  EXPECT_FALSE(AreTouching(kSquare, Moved({0.0, -1.2}), 0.1));
  EXPECT_FALSE(AreTouching(kSquare, {}, 10.0));
  // One within the other.
  EXPECT_TRUE(AreTouching(kSquare, {{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}}, 0.0));
  // The corner of one points at an edge of the other: only that edge separates them.
  const ConvexPolygon diamond{{1.1, 0.5}, {1.6, 0.0}, {2.1, 0.5}, {1.6, 1.0}};
  EXPECT_FALSE(AreTouching(kSquare, diamond, 0.05));
  EXPECT_FALSE(AreTouching(diamond, kSquare, 0.05));
}

}  // namespace
}  // namespace msc_vo
