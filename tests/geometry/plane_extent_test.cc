// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/plane_extent.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Eigen::Vector3d;

const Plane kWall({0.0, 0.0, -1.0}, 2.0);  // z = 2, seen from the origin
const PlaneExtent kPatch{{0.0, 0.0, 2.0}, {0.0, 1.0, 2.0}, {1.0, 1.0, 2.0}, {1.0, 0.0, 2.0}};

PlaneExtent MovedPatch(const Vector3d& offset) {
  return Rigid3({1.0, 0.0, 0.0, 0.0}, offset) * kPatch;
}

// Twice the area, along the normal if the vertices are counter-clockwise.
Vector3d AreaVector(const PlaneExtent& extent) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < extent.size(); ++i) {
    sum += extent[i].cross(extent[(i + 1) % extent.size()]);
  }
  return sum;
}

TEST(PlaneExtent, IsTheHullOfProjectedPoints) {
  PlaneExtent points = kPatch;
  points.emplace_back(0.5, 0.5, 2.3);
  points[1].z() = 1.9;
  const PlaneExtent hull = ConvexHull(kWall, points, 16);
  ASSERT_EQ(hull.size(), 4u);
  for (const Vector3d& vertex : hull) EXPECT_NEAR(vertex.z(), 2.0, 1e-12);
  EXPECT_LT((AreaVector(hull) - Vector3d(0.0, 0.0, -2.0)).norm(), 1e-12)
      << "counter-clockwise from the front";
}

TEST(PlaneExtent, HasABoundedNumberOfVertices) {
  PlaneExtent points;
  for (int i = 0; i < 50; ++i) points.emplace_back(std::cos(i), std::sin(i), 2.0);
  EXPECT_EQ(ConvexHull(kWall, points, 16).size(), 16u);
}

TEST(PlaneExtent, TouchesThatWithinTheGap) {
  EXPECT_TRUE(AreTouching(kWall, kPatch, MovedPatch({0.5, 0.5, 0.3}), 0.0));
  EXPECT_TRUE(AreTouching(kWall, kPatch, MovedPatch({1.2, 0.0, 0.0}), 0.25));
  EXPECT_FALSE(AreTouching(kWall, kPatch, MovedPatch({1.2, 0.0, 0.0}), 0.15));
  EXPECT_FALSE(AreTouching(kWall, kPatch, {}, 1.0));
}

TEST(PlaneExtent, MovesWithItsPlane) {
  const Rigid3 motion(ExpSO3({0.2, -0.3, 0.1}), {1.0, 2.0, -0.5});
  const Plane moved = motion * kWall;
  for (const Vector3d& vertex : motion* kPatch) {
    EXPECT_LT((Project(moved, vertex) - vertex).norm(), 1e-12);
  }
  EXPECT_NEAR((Project(kWall, {0.3, 0.4, 5.0}) - Vector3d(0.3, 0.4, 2.0)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace msc_vo
