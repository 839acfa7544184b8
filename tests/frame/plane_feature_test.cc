// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/plane_feature.h"

#include "tests/support/plane_features.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr double kFar = 1.0 / PlaneFeature::kMinInverseDepth;

// A floor one metre below the camera, whose horizon is the ray y = 0.
PlaneFeature Floor(const ConvexPolygon& hull) {
  PlaneFeature floor = FeatureOf(Plane({0.0, -1.0, 0.0}, 1.0));
  floor.hull = hull;
  return floor;
}

TEST(PlaneFeature, HasItsHullOnThePlane) {
  const PlaneExtent extent = Floor({{0.0, 0.25}, {0.5, 0.5}, {-0.5, 0.5}}).Extent();
  ASSERT_EQ(extent.size(), 3u);
  EXPECT_LT((extent[0] - Eigen::Vector3d(0.0, 1.0, 4.0)).norm(), 1e-12);
  EXPECT_LT((extent[1] - Eigen::Vector3d(1.0, 1.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((extent[2] - Eigen::Vector3d(-1.0, 1.0, 2.0)).norm(), 1e-12);
  EXPECT_TRUE(Floor({}).Extent().empty());
}

TEST(PlaneFeature, ClipsItsHullBeforeTheHorizon) {
  const PlaneExtent above = Floor({{0.0, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}).Extent();
  ASSERT_EQ(above.size(), 4u);
  EXPECT_LT((above[0] - kFar * Eigen::Vector3d(0.26, 0.02, 1.0)).norm(), 1e-9);
  EXPECT_LT((above[1] - Eigen::Vector3d(1.0, 1.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((above[2] - Eigen::Vector3d(-1.0, 1.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((above[3] - kFar * Eigen::Vector3d(-0.26, 0.02, 1.0)).norm(), 1e-9);
  const PlaneExtent below = Floor({{-0.5, -0.5}, {0.5, -0.5}, {0.0, 0.5}}).Extent();
  ASSERT_EQ(below.size(), 3u) << "one vertex is near enough, and its edges are clipped";
  for (const Eigen::Vector3d& vertex : below) EXPECT_NEAR(vertex.y(), 1.0, 1e-9);
}

TEST(PlaneFeature, HasNoExtentIfItIsTooFar) {
  EXPECT_TRUE(Floor({{0.0, -0.5}, {0.5, 0.01}, {-0.5, 0.01}}).Extent().empty());
}

TEST(PlaneFeature, MovesWithItsCameraFrame) {
  const Plane wall({0.0, 0.0, -1.0}, 2.0);
  PlaneFeature feature = FeatureOf(wall);
  feature.Move({Eigen::Quaterniond::Identity(), {0.3, 0.0, 0.5}});
  EXPECT_LT((feature.inverse_depth - Eigen::Vector3d(0.0, 0.0, 0.4)).norm(), 1e-12);
  // The velocity of a wrong pose would move the camera through the wall.
  feature.Move({Eigen::Quaterniond::Identity(), {0.0, 0.0, -3.0}});
  EXPECT_LT((feature.inverse_depth - Eigen::Vector3d(0.0, 0.0, 0.4)).norm(), 1e-12);
}

}  // namespace
}  // namespace msc_vo
