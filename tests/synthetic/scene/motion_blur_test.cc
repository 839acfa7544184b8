// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/motion_blur.h"

#include "tests/synthetic/scene/small_camera.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(MotionBlur, MeasuresTheMotionOfTheNearestSurface) {
  std::vector<float> depth(160 * 120, 4.0f);
  Rigid3 b_from_a;
  EXPECT_EQ(LargestImageMotion(kSmallCamera, depth, b_from_a), 0.0);
  b_from_a.translation() = Eigen::Vector3d(0.1, 0.0, 0.0);
  EXPECT_NEAR(LargestImageMotion(kSmallCamera, depth, b_from_a), kSmallCamera.fx * 0.1 / 4.0, 1e-6);
  depth[64 * 160 + 80] = 2.0f;
  EXPECT_NEAR(LargestImageMotion(kSmallCamera, depth, b_from_a), kSmallCamera.fx * 0.1 / 2.0, 1e-6);
  depth.assign(depth.size(), 0.0f);
  EXPECT_EQ(LargestImageMotion(kSmallCamera, depth, b_from_a), 0.0);
}

TEST(MotionBlur, TakesOneSamplePerPixelOfMotion) {
  EXPECT_EQ(NumExposureSamples(0.0), 1);
  EXPECT_EQ(NumExposureSamples(0.9), 1);
  EXPECT_EQ(NumExposureSamples(1.1), 2);
  EXPECT_EQ(NumExposureSamples(7.0), 7);
  EXPECT_EQ(NumExposureSamples(1e300), 32);
}

TEST(MotionBlur, RoundsTheMean) {
  ImageMean mean;
  mean.Add({0, 255, 10});
  EXPECT_EQ(mean.Value(), (std::vector<uint8_t>{0, 255, 10}));
  mean.Add({1, 255, 12});
  EXPECT_EQ(mean.Value(), (std::vector<uint8_t>{1, 255, 11}));
  mean.Add({0, 255, 10});
  EXPECT_EQ(mean.Value(), (std::vector<uint8_t>{0, 255, 11}));
}

}  // namespace
}  // namespace msc_vo
