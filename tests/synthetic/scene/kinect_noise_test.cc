// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/kinect_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/synthetic/scene/flat_depth.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Root mean square error over the pixels with depth.
double Rms(const std::vector<float>& depth, double truth) {
  double squares = 0.0;
  int count = 0;
  for (const float z : depth) {
    if (z == 0.0f) continue;
    squares += (z - truth) * (z - truth);
    ++count;
  }
  return std::sqrt(squares / count);
}

double MissingRatio(const std::vector<float>& depth) {
  return static_cast<double>(std::count(depth.begin(), depth.end(), 0.0f)) / depth.size();
}

// Mean over depths around `depth`, to average over positions between two quantisation steps.
double MeanRms(double depth) {
  double sum = 0.0;
  for (int i = 0; i < 10; ++i) {
    const float z = static_cast<float>(depth * (1.0 + 0.01 * i));
    std::vector<float> noisy = FlatDepth(z);
    AddKinectNoise({}, kDepthCamera, 1, i, &noisy);
    sum += Rms(noisy, z) / std::pow(1.0 + 0.01 * i, 2);
  }
  return sum / 10.0;
}

TEST(KinectNoiseTest, GrowsWithSquareOfDepth) {
  // sqrt(0.05^2 + 0.125^2 / 12) px of disparity over f b = 39.375 px m.
  const double sigma = std::sqrt(0.05 * 0.05 + 0.125 * 0.125 / 12.0) / (525.0 * 0.075);  // 1/metres
  for (const double depth : {1.0, 2.0, 4.0}) {
    EXPECT_NEAR(MeanRms(depth) / (sigma * depth * depth), 1.0, 0.12) << depth;
  }
}

TEST(KinectNoiseTest, QuantisesDisparity) {
  std::vector<float> depth = FlatDepth(2.3f);
  AddKinectNoise({}, kDepthCamera, 1, 0, &depth);
  for (const float z : depth) {
    if (z == 0.0f) continue;
    const double steps = 525.0 * 0.075 / z / 0.125;
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST(KinectNoiseTest, IsCorrelatedBetweenNeighboursOnly) {
  KinectNoiseOptions options;
  options.disparity_step = 1e-4;  // without quantisation
  std::vector<float> depth = FlatDepth(2.0f);
  AddKinectNoise(options, kDepthCamera, 1, 0, &depth);
  const auto correlation = [&](int distance) {
    double product = 0.0, squares = 0.0;
    for (int y = 0; y < kDepthCamera.height; ++y) {
      for (int x = 0; x + distance < kDepthCamera.width; ++x) {
        const double a = 1.0 / depth[y * kDepthCamera.width + x] - 0.5;
        product += a * (1.0 / depth[y * kDepthCamera.width + x + distance] - 0.5);
        squares += a * a;
      }
    }
    return product / squares;
  };
  // Autocorrelation of the kernel at one pixel: exp(-1 / (4 sigma^2)) with sigma = 0.75 px at this
  // image size.
  EXPECT_NEAR(correlation(1), std::exp(-1.0 / (4.0 * 0.75 * 0.75)), 0.05);
  EXPECT_NEAR(correlation(10), 0.0, 0.05);
}

TEST(KinectNoiseTest, RemovesDepthOutsideRange) {
  for (const float z : {0.3f, 5.5f}) {
    std::vector<float> depth = FlatDepth(z);
    AddKinectNoise({}, kDepthCamera, 1, 0, &depth);
    EXPECT_EQ(MissingRatio(depth), 1.0) << z;
  }
  std::vector<float> depth = FlatDepth(2.0f);
  AddKinectNoise({}, kDepthCamera, 1, 0, &depth);
  EXPECT_EQ(MissingRatio(depth), 0.0);
  std::vector<float> missing = FlatDepth(0.0f);
  AddKinectNoise({}, kDepthCamera, 1, 0, &missing);
  EXPECT_EQ(MissingRatio(missing), 1.0);
}

// Depth of a plane through (0, 0, 2); `tangent` is that of the angle between its normal and the
// optical axis.
std::vector<float> Slanted(double tangent) {
  std::vector<float> depth = FlatDepth(0.0f);
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (int x = 0; x < kDepthCamera.width; ++x) {
      const double w = (1.0 - tangent * (x - kDepthCamera.cx) / kDepthCamera.fx) / 2.0;
      depth[y * kDepthCamera.width + x] = w > 0.0 ? static_cast<float>(1.0 / w) : 0.0f;
    }
  }
  return depth;
}

double MissingRatioInMiddle(double tangent) {
  std::vector<float> depth = Slanted(tangent);
  AddKinectNoise({}, kDepthCamera, 1, 0, &depth);
  int missing = 0;
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (int x = 158; x < 162; ++x) missing += depth[y * kDepthCamera.width + x] == 0.0f ? 1 : 0;
  }
  return missing / (4.0 * kDepthCamera.height);
}

TEST(KinectNoiseTest, RemovesDepthAtGrazingAngles) {
  EXPECT_EQ(MissingRatioInMiddle(1.0), 0.0);
  EXPECT_NEAR(MissingRatioInMiddle(6.0), 0.5, 0.07);
  EXPECT_NEAR(MissingRatioInMiddle(20.0), 0.95, 0.03);
}

TEST(KinectNoiseTest, RemovesDepthAtEdges) {
  std::vector<float> depth = FlatDepth(1.5f);
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (int x = 160; x < kDepthCamera.width; ++x) depth[y * kDepthCamera.width + x] = 3.0f;
  }
  AddKinectNoise({}, kDepthCamera, 1, 0, &depth);
  int missing = 0, elsewhere = 0;
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (int x = 0; x < kDepthCamera.width; ++x) {
      const bool none = depth[y * kDepthCamera.width + x] == 0.0f;
      (x == 159 || x == 160 ? missing : elsewhere) += none ? 1 : 0;
    }
  }
  EXPECT_GT(missing, 2 * kDepthCamera.height * 0.9);
  EXPECT_EQ(elsewhere, 0);
}

TEST(KinectNoiseTest, IsIndependentOfImageSize) {
  const PinholeCamera large = KinectCamera(640, 480);
  std::vector<float> a = FlatDepth(2.0f), b(640 * 480, 2.0f);
  AddKinectNoise({}, kDepthCamera, 1, 0, &a);
  AddKinectNoise({}, large, 1, 0, &b);
  EXPECT_NEAR(Rms(a, 2.0) / Rms(b, 2.0), 1.0, 0.1);
}

TEST(KinectNoiseTest, IsDeterminedBySeedAndFrame) {
  std::vector<float> a = FlatDepth(2.0f), b = a, frame = a, seed = a;
  AddKinectNoise({}, kDepthCamera, 1, 4, &a);
  AddKinectNoise({}, kDepthCamera, 1, 4, &b);
  AddKinectNoise({}, kDepthCamera, 1, 5, &frame);
  AddKinectNoise({}, kDepthCamera, 2, 4, &seed);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, frame);
  EXPECT_NE(a, seed);
}

TEST(KinectNoiseTest, ThrowsOnInvalidOptionsOrSize) {
  std::vector<float> depth(7, 1.0f);
  EXPECT_THROW(AddKinectNoise({}, kDepthCamera, 1, 0, &depth), std::invalid_argument);
  KinectNoiseOptions options;
  options.max_depth = 0.1;
  std::vector<float> good = FlatDepth(1.0f);
  EXPECT_THROW(AddKinectNoise(options, kDepthCamera, 1, 0, &good), std::invalid_argument);
}

// Depth of ICL-NUIM is a whole number of steps of 1/351.3 1/m, half a step nearer in the mean.
TEST(KinectNoiseTest, OfIclNuimRoundsHalfAStepUpwards) {
  double error = 0.0;  // of inverse depth, steps
  int count = 0;
  for (int i = 0; i < 20; ++i) {
    const float z = 2.0f + 0.005f * static_cast<float>(i);
    std::vector<float> depth = FlatDepth(z);
    AddKinectNoise(IclNuimNoise(), kDepthCamera, 1, i, &depth);
    for (const float noisy : depth) {
      ASSERT_GT(noisy, 0.0f);
      const double steps = 351.3 / noisy;
      ASSERT_NEAR(steps, std::round(steps), 1e-3);
      error += steps - 351.3 / z;
      ++count;
    }
  }
  EXPECT_NEAR(error / count, 0.5, 0.05);
}

TEST(KinectNoiseTest, DisplacesDepth) {
  // The depth jumps between columns 159 and 160.
  std::vector<float> depth = FlatDepth(2.0f);
  for (size_t i = 0; i < depth.size(); ++i) {
    if (static_cast<int>(i % kDepthCamera.width) >= 160) depth[i] = 3.0f;
  }
  KinectNoiseOptions options = IclNuimNoise();
  options.lateral_sigma = 0.0;
  options.lateral_offset = {8.0, 0.0};  // 4 px of this image
  AddKinectNoise(options, kDepthCamera, 1, 0, &depth);
  const size_t row = static_cast<size_t>(100) * kDepthCamera.width;
  EXPECT_LT(depth[row + 155], 2.1f);
  EXPECT_GT(depth[row + 156], 2.9f);
}

}  // namespace
}  // namespace msc_vo
