// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/plane_matcher.h"

#include <cmath>
#include <utility>

#include "tests/support/plane_features.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

MapPlanes MapOf(const std::vector<Plane>& planes) {
  MapPlanes map;
  for (const Plane& plane : planes) {
    map.planes.push_back({static_cast<LandmarkId>(10 * map.planes.size()), plane});
  }
  return map;
}

const PoseCovariance kCertain = PoseCovariance::Zero();
const Plane kWall({0.0, 0.0, -1.0}, 2.0), kSide({-1.0, 0.0, 0.0}, 1.0);

TEST(MatchPlanes, FindsPlanesFromANearbyPose) {
  const MapPlanes map = MapOf({kWall, kSide});
  const Rigid3 truth(ExpSO3({0.0, 0.1, 0.0}), {0.1, 0.0, 0.2});
  const std::vector<PlaneFeature> features{FeatureOf(truth * kSide), FeatureOf(truth * kWall)};
  const Rigid3 predicted = Rigid3(ExpSO3({0.0, 0.003, 0.0}), {0.005, 0.0, 0.005}) * truth;
  const std::vector<PlaneMatch> matches =
      MatchPlanes(features, map, predicted, IsotropicCovariance(0.003, 0.005));
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].plane, 10);
  EXPECT_EQ(matches[1].plane, 0);
}

TEST(MatchPlanes, DependsOnTheUncertaintyOfThePose) {
  const MapPlanes map = MapOf({kWall});
  const std::vector<PlaneFeature> features{FeatureOf(Plane({0.0, 0.0, -1.0}, 2.1))};
  EXPECT_TRUE(MatchPlanes(features, map, {}, kCertain).empty()) << "0.024 1/m, six sigmas";
  EXPECT_EQ(MatchPlanes(features, map, {}, IsotropicCovariance(0.002, 0.05)).size(), 1u);
  EXPECT_TRUE(MatchPlanes(features, map, {}, IsotropicCovariance(0.002, 0.2)).empty())
      << "from there, the plane may be another one";
}

// The rotation of a pose acts on its translation with a lever arm.
TEST(MatchPlanes, TakesTheCovarianceInTheTangentOfThePose) {
  const Rigid3 truth(ExpSO3({0.0, 0.1, 0.0}), {60.0, 0.0, 0.2});  // far from the world's origin
  const Plane wall({0.0, 0.0, -1.0}, 2.0);
  const std::vector<PlaneFeature> features{FeatureOf(wall)};
  const MapPlanes map = MapOf({truth.Inverse() * wall});
  const PoseCovariance of_camera = IsotropicCovariance(0.003, 0.003);
  EXPECT_EQ(MatchPlanes(features, map, truth, CovarianceOfCamera(truth, of_camera)).size(), 1u);
  EXPECT_TRUE(MatchPlanes(features, map, truth, of_camera).empty());
}

TEST(MatchPlanes, TellsParallelPlanesApart) {
  const Plane panel({0.0, 0.0, -1.0}, 1.8);  // 20 cm in front of the wall
  const auto matches =
      MatchPlanes({FeatureOf(panel), FeatureOf(kWall)}, MapOf({kWall, panel}), {}, kCertain);
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].plane, 10);
  EXPECT_EQ(matches[1].plane, 0);
  EXPECT_TRUE(MatchPlanes({FeatureOf(panel)}, MapOf({kWall}), {}, kCertain).empty());
}

TEST(MatchPlanes, MatchesPartsOfOneWallWithIt) {
  EXPECT_EQ(MatchPlanes({FeatureOf(kWall), FeatureOf(kWall)}, MapOf({kWall}), {}, kCertain).size(),
            2u);
}

// An extent of one square metre on the plane z = 2.
PlaneExtent Square(double x) {
  return {{x, 0.0, 2.0}, {x, 1.0, 2.0}, {x + 1.0, 1.0, 2.0}, {x + 1.0, 0.0, 2.0}};
}

TEST(MatchPlanes, PrefersThePlaneWhoseExtentIsSeen) {
  MapPlanes map = MapOf({kWall, Plane({0.0, 0.0, -1.0}, 2.01)});
  map.planes[0].extent = Square(3.0);
  map.planes[1].extent = Square(0.0);
  PlaneFeature feature = FeatureOf(kWall);
  EXPECT_EQ(MatchPlanes({feature}, map, {}, kCertain)[0].plane, 0) << "without a hull, the nearest";
  feature.hull = {{0.1, 0.1}, {0.4, 0.1}, {0.2, 0.4}};
  EXPECT_EQ(MatchPlanes({feature}, map, {}, kCertain)[0].plane, 10);
  std::swap(map.planes[0].extent, map.planes[1].extent);
  EXPECT_EQ(MatchPlanes({feature}, map, {}, kCertain)[0].plane, 0);
  map.planes[0].extent = map.planes[1].extent;
  EXPECT_EQ(MatchPlanes({feature}, map, {}, kCertain)[0].plane, 0)
      << "if none is seen, the nearest";
}

TEST(AreSamePlane, WithinTheUncertaintyOfTheFeature) {
  const PlaneFeature feature = FeatureOf(kWall);  // of 4e-3 1/m, that is 16 mm at 2 m
  const auto same = [&](const Plane& other, double x = 0.0) {
    return AreSamePlane(feature, {0, kWall, Square(0.0)}, {1, other, Square(x)}, 1.0);
  };
  EXPECT_TRUE(same({{0.0, 0.0, -1.0}, 2.03}));
  EXPECT_FALSE(same({{0.0, 0.0, -1.0}, 2.08}));
  // A tilt that the patch of the feature tolerates, but not the far end of the other extent.
  const double angle = 0.02;
  const Plane tilted({std::sin(angle), 0.0, -std::cos(angle)}, 2.0 * std::cos(angle));
  EXPECT_TRUE(same(tilted));
  EXPECT_FALSE(AreSamePlane(feature, {0, kWall, {}},
                            {1, tilted, {{5.0, 0.0, 2.1}, {5.0, 1.0, 2.1}, {6.0, 0.0, 2.12}}},
                            0.2));
}

// A wall has two sides.
TEST(MatchPlanes, DoesNotMatchTheBackOfAPlane) {
  const Plane back({0.0, 0.0, 1.0}, -2.0);
  EXPECT_TRUE(MatchPlanes({FeatureOf(kWall)}, MapOf({back}), {}, kCertain).empty());
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
