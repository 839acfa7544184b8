// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/depth_artifacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/synthetic/scene/flat_depth.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A box 1.5 m away, columns 100 to 199, in front of a wall at 3 m.
std::vector<float> Box() {
  std::vector<float> depth = FlatDepth(3.0f);
  for (size_t i = 0; i < depth.size(); ++i) {
    const size_t x = i % kDepthCamera.width;
    if (x >= 100 && x < 200) depth[i] = 1.5f;
  }
  return depth;
}

float At(const std::vector<float>& depth, int x, int y) {
  return depth[static_cast<size_t>(y) * kDepthCamera.width + x];
}

// Standard deviation over the pixels with depth.
double Deviation(const std::vector<float>& depth) {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (const float z : depth) {
    if (z == 0.0f) continue;
    sum += z;
    squares += static_cast<double>(z) * z;
    ++count;
  }
  return std::sqrt(squares / count - sum * sum / count / count);
}

// Correlation of the errors of pixels `distance` apart in a row, for depth around `truth`.
double Correlation(const std::vector<float>& depth, double truth, int distance) {
  double products = 0.0, squares = 0.0;
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (int x = 0; x + distance < kDepthCamera.width; ++x) {
      const double a = At(depth, x, y), b = At(depth, x + distance, y);
      if (a == 0.0 || b == 0.0) continue;
      products += (a - truth) * (b - truth);
      squares += (a - truth) * (a - truth);
    }
  }
  return products / squares;
}

TEST(TimeOfFlightNoise, GrowsWithDepthAndIsIndependentBetweenPixels) {
  TimeOfFlightOptions options;
  options.bias = 0.0;
  for (const float z : {1.0f, 2.0f, 4.0f}) {
    std::vector<float> depth = FlatDepth(z);
    AddTimeOfFlightNoise(options, kDepthCamera, 1, 0, &depth);
    EXPECT_NEAR(Deviation(depth), 0.0015 + 0.0025 * z, 1e-4) << z;
    EXPECT_NEAR(Correlation(depth, z, 1), 0.0, 0.02) << z;
  }
}

TEST(TimeOfFlightNoise, MixesSurfacesBesideEdgesOnly) {
  std::vector<float> depth = Box();
  AddTimeOfFlightNoise({}, kDepthCamera, 1, 0, &depth);
  int num_mixed = 0;
  for (int y = 0; y < kDepthCamera.height; ++y) {
    for (const int x : {99, 100, 199, 200}) num_mixed += std::abs(At(depth, x, y) - 2.25) < 0.6;
    for (const int x : {97, 102, 197, 202}) {
      EXPECT_GT(std::abs(At(depth, x, y) - 2.25), 0.6) << x << " " << y;
    }
  }
  EXPECT_GT(num_mixed, 2 * kDepthCamera.height);
}

TEST(StereoNoise, GrowsWithTheSquareOfDepthAndIsCorrelatedOverTheWindow) {
  StereoOptions options;
  options.hole_ratio = 0.0;
  // Disparity noise of 0.08 px over f b = 525 px * 0.05 m.
  for (const float z : {1.0f, 2.0f, 4.0f}) {
    std::vector<float> depth = FlatDepth(z);
    AddStereoNoise(options, kDepthCamera, 1, 0, &depth);
    EXPECT_NEAR(Deviation(depth) / (0.08 / (525.0 * 0.05) * z * z), 1.0, 0.15) << z;
    // Gaussians of 2 px smooth white noise: exp(-d^2 / 16).
    EXPECT_NEAR(Correlation(depth, z, 2), std::exp(-0.25), 0.06) << z;
    EXPECT_NEAR(Correlation(depth, z, 12), 0.0, 0.1) << z;
  }
}

TEST(StereoNoise, ExtendsNearSurfacesAndHasHoles) {
  StereoOptions options;
  options.disparity_sigma = 0.0;
  std::vector<float> depth = Box();
  AddStereoNoise(options, kDepthCamera, 1, 0, &depth);
  const double missing = static_cast<double>(std::count(depth.begin(), depth.end(), 0.0f)) /
                         static_cast<double>(depth.size());
  EXPECT_NEAR(missing, 0.1, 0.01);
  // The window reaches 4 px of 640, 2 of 320.
  for (int y = 0; y < kDepthCamera.height; ++y) {
    const float inside = At(depth, 98, y), outside = At(depth, 97, y);
    EXPECT_TRUE(inside == 0.0f || std::abs(inside - 1.5f) < 1e-4f) << y;
    EXPECT_TRUE(outside == 0.0f || std::abs(outside - 3.0f) < 1e-4f) << y;
  }
}

TEST(LidarNoise, HasWideEdgesAndSmoothSurfaces) {
  std::vector<float> depth = Box();
  AddLidarNoise({}, kDepthCamera, 1, 0, &depth);
  double step = 0.0;  // the largest at the edge
  for (int x = 94; x < 106; ++x) {
    step = std::max<double>(step, std::abs(At(depth, x + 1, 120) - At(depth, x, 120)));
  }
  EXPECT_LT(step, 1.1);
  for (int x = 20; x < 80; ++x) {
    EXPECT_NEAR(At(depth, x + 1, 120), At(depth, x, 120), 0.005) << x;
    EXPECT_NEAR(At(depth, x, 120), 3.0, 0.05) << x;
  }
}

TEST(DepthArtifacts, DependOnSeedAndFrameOnly) {
  for (const auto add : {+[](uint64_t frame, std::vector<float>*depth) {
                           AddTimeOfFlightNoise({}, kDepthCamera, 1, frame, depth);
                         },
                         +[](uint64_t frame, std::vector<float>*depth) {
                           AddStereoNoise({}, kDepthCamera, 1, frame, depth);
                         },
                         +[](uint64_t frame, std::vector<float>*depth) {
                           AddLidarNoise({}, kDepthCamera, 1, frame, depth);
                         }}) {
    std::vector<float> a = Box(), b = Box(), c = Box();
    add(3, &a);
    add(3, &b);
    add(4, &c);
    EXPECT_EQ(a, b);
    EXPECT_NE(a, c);
  }
}

TEST(DepthArtifacts, RejectInvalidOptions) {
  std::vector<float> depth = Box(), small(10, 1.0f);
  TimeOfFlightOptions time_of_flight;
  time_of_flight.sigma = -1.0;
  EXPECT_THROW(AddTimeOfFlightNoise(time_of_flight, kDepthCamera, 1, 0, &depth),
               std::invalid_argument);
  StereoOptions stereo;
  stereo.baseline = 0.0;
  EXPECT_THROW(AddStereoNoise(stereo, kDepthCamera, 1, 0, &depth), std::invalid_argument);
  LidarOptions lidar;
  lidar.columns = 1;
  EXPECT_THROW(AddLidarNoise(lidar, kDepthCamera, 1, 0, &depth), std::invalid_argument);
  EXPECT_THROW(AddLidarNoise({}, kDepthCamera, 1, 0, &small), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
