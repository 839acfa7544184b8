// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/motion_limits.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(MotionLimits, AllowSlowMotionsOfACameraThatWasAtRest) {
  const MotionLimits limits;
  EXPECT_TRUE(limits.Allow({{0.0, 0.8, 0.0}, {0.4, 0.0, 0.0}}));
}

TEST(MotionLimits, AllowNoJump) {
  MotionLimits limits;
  limits.Observe({{0.0, 0.3, 0.0}, {0.5, 0.0, 0.0}});
  EXPECT_FALSE(limits.Allow({{0.0, 2.0, 0.0}, {}}));
  EXPECT_FALSE(limits.Allow({{}, {0.0, 0.0, 2.0}}));
}

TEST(MotionLimits, AllowThreeTimesTheLargestSpeed) {
  MotionLimits limits;
  limits.Observe({{0.0, 0.5, 0.0}, {0.5, 0.0, 0.0}});
  EXPECT_TRUE(limits.Allow({{0.0, 1.45, 0.0}, {1.45, 0.0, 0.0}}));
  EXPECT_FALSE(limits.Allow({{0.0, 1.55, 0.0}, {}}));
  EXPECT_FALSE(limits.Allow({{}, {1.55, 0.0, 0.0}}));
}

TEST(MotionLimits, AllowWhatTheCameraHasShown) {
  MotionLimits limits;
  limits.Observe({{0.0, 6.0, 0.0}, {5.0, 0.0, 0.0}});
  limits.Observe({{0.0, 0.1, 0.0}, {0.1, 0.0, 0.0}});
  EXPECT_TRUE(limits.Allow({{0.0, 0.0, 7.0}, {0.0, 0.0, 8.0}}));
}

}  // namespace
}  // namespace msc_vo
