// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/depth_bleeding.h"
#include "msc_vo/sensor/flying_pixels.h"

namespace msc_vo {
namespace {

constexpr int kWidth = 640, kHeight = 200;

bool InBox(int x, int y) { return x >= 200 && x < 400 && y >= 60 && y < 150; }

// A dark box 1.5 m away before a bright wall at 3 m.
cv::Mat BoxImage() {
  cv::Mat gray(kHeight, kWidth, CV_8UC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) gray.at<uint8_t>(y, x) = InBox(x, y) ? 60 : 180;
  }
  return gray;
}

cv::Mat BoxDepth(int shift = 0) {
  cv::Mat depth(kHeight, kWidth, CV_32FC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) depth.at<float>(y, x) = InBox(x - shift, y) ? 1.5f : 3.0f;
  }
  return depth;
}

// The depth with the nearest surface within `reach` pixels.
cv::Mat Bleeding(const cv::Mat& depth, int reach) {
  cv::Mat nearest;
  cv::erode(depth, nearest,
            cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1}));
  return nearest;
}

int Reach(const cv::Mat& depth) {
  BleedingEstimator estimator(kWidth);
  estimator.Add(BoxImage(), depth);
  return estimator.reach();
}

TEST(BleedingEstimator, FindsTheReachFromTheEdgesOfTheImage) {
  EXPECT_EQ(Reach(BoxDepth()), 0);
  for (const int reach : {2, 4, 6}) EXPECT_EQ(Reach(Bleeding(BoxDepth(), reach)), reach);
}

TEST(BleedingEstimator, IsNotMisledByAShiftOfTheDepthImage) {
  EXPECT_NEAR(Reach(Bleeding(BoxDepth(1), 4)), 4, 1);
}

TEST(BleedingEstimator, HasATypicalReachWithoutEdges) {
  BleedingEstimator estimator(kWidth);
  estimator.Add(BoxImage(), cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(2.0)));
  EXPECT_FALSE(estimator.IsDone());
  EXPECT_EQ(estimator.reach(), 4);
}

TEST(RemoveBleeding, RestoresOutlinesAndInclinedSurfaces) {
  const cv::Mat box = RemoveBleeding(Bleeding(BoxDepth(), 4), 4, 0.0);
  EXPECT_EQ(cv::norm(box, BoxDepth(), cv::NORM_INF), 0.0);
  cv::Mat wall(kHeight, kWidth, CV_32FC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      wall.at<float>(y, x) = static_cast<float>(1.0 / (0.2 + 0.001 * x));
  }
  const cv::Mat restored = RemoveBleeding(Bleeding(wall, 4), 4, 0.0);
  EXPECT_EQ(restored.at<float>(100, 300), wall.at<float>(100, 300));
}

TEST(RemoveBleeding, KeepsHolesAndLeavesDepthWithoutReach) {
  cv::Mat depth = BoxDepth();
  depth.at<float>(100, 300) = 0.0f;
  EXPECT_EQ(RemoveBleeding(depth, 3, 0.0).at<float>(100, 300), 0.0f);
  EXPECT_EQ(cv::norm(RemoveBleeding(depth, 0, 0.003), depth, cv::NORM_INF), 0.0);
}

DepthNoise MillimetresPerMetre(double sigma) {
  DepthNoise noise = 0.0;
  noise.proportional = 1e-3 * sigma;
  return noise;
}

TEST(RemoveFlyingPixels, RemovesMixturesAndKeepsBothSurfaces) {
  cv::Mat depth = BoxDepth();
  for (int y = 60; y < 150; ++y) {
    depth.at<float>(y, 199) = 1.8f + 0.007f * static_cast<float>((y * 37) % 150);  // 1.8 to 2.85 m
  }
  const cv::Mat kept = RemoveFlyingPixels(depth, MillimetresPerMetre(2.0));
  for (int y = 65; y < 145; ++y) {
    EXPECT_EQ(kept.at<float>(y, 199), 0.0f) << y;
    EXPECT_EQ(kept.at<float>(y, 200), 1.5f) << y;  // five neighbours on the box
    EXPECT_EQ(kept.at<float>(y, 198), 3.0f) << y;
  }
}

TEST(RemoveFlyingPixels, KeepsNoisySurfaces) {
  cv::Mat depth(kHeight, kWidth, CV_32FC1);
  cv::RNG random(7);
  random.fill(depth, cv::RNG::NORMAL, 3.0, 0.006);
  const cv::Mat kept = RemoveFlyingPixels(depth, MillimetresPerMetre(2.0));
  EXPECT_GT(cv::countNonZero(kept), 0.999 * (kWidth - 2) * (kHeight - 2));
}

}  // namespace
}  // namespace msc_vo
