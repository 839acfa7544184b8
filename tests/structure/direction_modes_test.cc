// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/direction_modes.h"

#include "tests/structure/evidence.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector3d;

constexpr double kBandwidth = DegreesToRadians(3.0);
constexpr double kSeparation = DegreesToRadians(10.0);

std::vector<WeightedDirection> Weighted(const testing::Evidence& evidence, double weight) {
  std::vector<WeightedDirection> directions;
  for (const AxisEvidence& item : evidence) directions.push_back({item.direction, weight});
  return directions;
}

TEST(DirectionModes, FindsTheDensestFirstIndependentOfSigns) {
  Random random(1);
  testing::Evidence evidence;
  const Vector3d heavy = Vector3d(1, 2, 3).normalized();
  const Vector3d light = Vector3d(-3, 1, 0.5).normalized();
  testing::AddAlong(light, 100, DegreesToRadians(2.0), &random, &evidence);
  testing::AddAlong(heavy, 200, DegreesToRadians(2.0), &random, &evidence);
  const auto modes = FindDirectionModes(Weighted(evidence, 1.0), kBandwidth, kSeparation, 2);
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_LT(RadiansToDegrees(UndirectedAngle(modes[0], heavy)), 0.5);
  EXPECT_LT(RadiansToDegrees(UndirectedAngle(modes[1], light)), 0.5);
}

TEST(DirectionModes, SumsWeights) {
  std::vector<WeightedDirection> directions = {{Vector3d::UnitX(), 3.0}};
  for (int i = 0; i < 2; ++i) directions.push_back({Vector3d::UnitY(), 1.0});
  const auto modes = FindDirectionModes(directions, kBandwidth, kSeparation, 12);
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_EQ(modes[0], Vector3d::UnitX());
  EXPECT_EQ(modes[1], Vector3d::UnitY());
}

TEST(DirectionModes, AreSeparatedAndLimitedInNumber) {
  Random random(2);
  testing::Evidence evidence;
  testing::AddClutter(500, 0.0, &random, &evidence);
  const auto modes = FindDirectionModes(Weighted(evidence, 1.0), kBandwidth, kSeparation, 7);
  ASSERT_EQ(modes.size(), 7u);
  for (size_t i = 0; i < modes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) EXPECT_GE(UndirectedAngle(modes[i], modes[j]), kSeparation);
  }
}

TEST(DirectionModes, FindsNoneWithoutDirections) {
  EXPECT_TRUE(FindDirectionModes({}, kBandwidth, kSeparation, 12).empty());
}

}  // namespace
}  // namespace msc_vo
