// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/angles.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(UndirectedAngle, MatchesKnownAngles) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_DOUBLE_EQ(UndirectedAngle(x, Eigen::Vector3d(3.0, 0.0, 0.0)), 0.0);
  EXPECT_DOUBLE_EQ(UndirectedAngle(x, Eigen::Vector3d(-3.0, 0.0, 0.0)), 0.0);
  EXPECT_DOUBLE_EQ(UndirectedAngle(x, Eigen::Vector3d(0.0, -2.0, 0.0)), 0.5 * kPi);
  EXPECT_NEAR(UndirectedAngle(x, Eigen::Vector3d(-1.0, 0.0, 1.0)), 0.25 * kPi, 1e-15);
  EXPECT_NEAR(UndirectedAngle(Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-2.0, 2.0)), 0.25 * kPi,
              1e-15);
  EXPECT_DOUBLE_EQ(UndirectedAngle(Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-2.0, 0.0)), 0.0);
}

TEST(UndirectedAngle, IsAccurateForTinyAngles) {
  // The arc cosine of a dot product is 0 here.
  const double tiny = 1e-9;
  const Eigen::Vector3d a = Eigen::Vector3d::UnitX(), b(std::cos(tiny), std::sin(tiny), 0.0);
  EXPECT_NEAR(UndirectedAngle(a, b), tiny, 1e-15);
  EXPECT_NEAR(UndirectedAngle(a, Eigen::Vector3d(-b)), tiny, 1e-15);
}

TEST(DegreesToRadians, InvertsRadiansToDegrees) {
  EXPECT_DOUBLE_EQ(DegreesToRadians(180.0), kPi);
  EXPECT_DOUBLE_EQ(RadiansToDegrees(DegreesToRadians(37.0)), 37.0);
}

}  // namespace
}  // namespace msc_vo
