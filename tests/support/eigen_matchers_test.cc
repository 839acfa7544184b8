// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/eigen_matchers.h"

#include <limits>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using ::testing::Not;

TEST(IsNear, BoundsEveryEntry) {
  const Eigen::Vector3d value(1.0, -2.0, 3.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(value, IsNear(value + 0.1 * Eigen::Vector3d::Unit(i), 0.11));
    EXPECT_THAT(value, Not(IsNear(value - 0.1 * Eigen::Vector3d::Unit(i), 0.09)));
  }
}

TEST(IsNear, RefusesOtherSizes) {
  EXPECT_THAT(Eigen::Vector3d::Zero(), Not(IsNear(Eigen::Vector2d::Zero(), 1.0)));
  EXPECT_THAT(Eigen::Vector3d::Zero(), Not(IsNear(Eigen::RowVector3d::Zero(), 1.0)));
}

TEST(IsNear, RefusesNaN) {
  Eigen::Matrix4d value = Eigen::Matrix4d::Zero();
  value(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(value, Not(IsNear(Eigen::Matrix4d::Zero(), 1.0)));
  EXPECT_THAT(Eigen::Matrix4d::Zero(), Not(IsNear(value, 1.0)));
}

}  // namespace
}  // namespace msc_vo
