// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

PlaneFeature FeatureOf(const Plane& in_cam) {
  PlaneFeature feature;
  feature.inverse_depth = -in_cam.normal() / in_cam.offset();
  feature.covariance = 1.6e-5 * Eigen::Matrix3d::Identity();
  feature.mean_square_ray = Eigen::Vector3d(0.1, 0.06, 1.0).asDiagonal();
  return feature;
}

MapPlanes MapOf(const std::vector<Plane>& planes) {
  MapPlanes map;
  for (const Plane& plane : planes) {
    map.planes.push_back({static_cast<LandmarkId>(10 * map.planes.size()), plane});
  }
  return map;
}

const Plane kWall({0.0, 0.0, -1.0}, 2.0), kSide({-1.0, 0.0, 0.0}, 1.0);

TEST(MatchPlanes, FindsPlanesFromANearbyPose) {
  const MapPlanes map = MapOf({kWall, kSide});
  const Rigid3 truth(ExpSO3({0.0, 0.1, 0.0}), {0.1, 0.0, 0.2});
  const std::vector<PlaneFeature> features{FeatureOf(truth * kSide), FeatureOf(truth * kWall)};
  const Rigid3 predicted = Rigid3(ExpSO3({0.0, 0.003, 0.0}), {0.005, 0.0, 0.005}) * truth;
  const std::vector<PlaneMatch> matches = MatchPlanes(features, map, predicted);
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].plane, 10);
  EXPECT_EQ(matches[1].plane, 0);
}

TEST(MatchPlanes, TellsParallelPlanesApart) {
  const Plane panel({0.0, 0.0, -1.0}, 1.8);  // 20 cm in front of the wall
  const auto matches = MatchPlanes({FeatureOf(panel), FeatureOf(kWall)}, MapOf({kWall, panel}), {});
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].plane, 10);
  EXPECT_EQ(matches[1].plane, 0);
  EXPECT_TRUE(MatchPlanes({FeatureOf(panel)}, MapOf({kWall}), {}).empty());
}

TEST(MatchPlanes, MatchesPartsOfOneWallWithIt) {
  EXPECT_EQ(MatchPlanes({FeatureOf(kWall), FeatureOf(kWall)}, MapOf({kWall}), {}).size(), 2u);
}

// A wall has two sides.
TEST(MatchPlanes, DoesNotMatchTheBackOfAPlane) {
  const Plane back({0.0, 0.0, 1.0}, -2.0);
  EXPECT_TRUE(MatchPlanes({FeatureOf(kWall)}, MapOf({back}), {}).empty());
}

TEST(DetermineAPose, NeedsThreeDirections) {
  const Plane floor({0.0, -1.0, 0.0}, 1.4), far({0.0, 0.0, -1.0}, 5.0);
  EXPECT_FALSE(DetermineAPose({}));
  EXPECT_FALSE(DetermineAPose({FeatureOf(kWall), FeatureOf(kSide)}));
  EXPECT_FALSE(DetermineAPose({FeatureOf(kWall), FeatureOf(kSide), FeatureOf(far)}));
  EXPECT_TRUE(DetermineAPose({FeatureOf(kWall), FeatureOf(kSide), FeatureOf(floor)}));
}

}  // namespace
}  // namespace msc_vo
