// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_sampler.h"

#include <cmath>
#include <limits>

#include "tests/features/depth_images.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector2d;

constexpr double kSigma = 1.4e-3;

PinholeCamera SmallCamera() { return {240.0, 240.0, 79.5, 59.5, 160, 120}; }

InverseDepthImage Image(const cv::Mat& depth) { return InverseDepthImage(depth, 0.2, 10.0); }

double SlantedPlane(const Vector2d& x) { return 0.5 + 0.001 * x.x() - 0.0007 * x.y(); }

// A depth edge at x = 60: 1 m on the left, 2 m on the right.
double StepAt60(const Vector2d& x) { return x.x() < 60.0 ? 1.0 : 0.5; }

TEST(InverseDepthImage, IsZeroWithoutValidDepth) {
  cv::Mat depth(1, 6, CV_32FC1);
  const float values[] = {2.0f, 0.0f, 0.1f, 20.0f, std::numeric_limits<float>::quiet_NaN(), -1.0f};
  for (int x = 0; x < 6; ++x) depth.at<float>(0, x) = values[x];
  const InverseDepthImage image = Image(depth);
  EXPECT_FLOAT_EQ(image.At(0, 0), 0.5);
  for (int x = 1; x < 6; ++x) EXPECT_EQ(image.At(x, 0), 0.0) << x;
  EXPECT_EQ(image.At(-1, 0), 0.0);
  EXPECT_EQ(image.At(6, 0), 0.0);
  EXPECT_EQ(image.At(0, 1), 0.0);
  EXPECT_FLOAT_EQ(image.Nearest({0.4, -0.4}), 0.5);
}

TEST(DepthSampler, IsExactOnSlantedPlane) {
  const auto image = Image(testing::DrawDepth(SmallCamera(), SlantedPlane));
  // The last pixel is in the corner of the image.
  for (const Vector2d& pixel : {Vector2d(40.3, 70.8), Vector2d(99.5, 20.5), Vector2d(0.2, 0.1)}) {
    const auto sample = SampleDepth(image, pixel, kSigma);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->inverse_depth, SlantedPlane(pixel), 1e-4);
    EXPECT_GE(sample->sigma, kSigma);
    EXPECT_LT(sample->sigma, 1.3 * kSigma);
  }
}

TEST(DepthSampler, IsUnbiasedAtFold) {
  // The fold of two walls, concave or convex, and the corner of three.
  constexpr double kSlope = 1e-3;  // 1/metres per pixel
  for (const double sign : {1.0, -1.0}) {
    const auto fold = [&](const Vector2d& x) {
      return 0.4 + sign * kSlope * std::abs(x.x() - 60.3);
    };
    const auto corner = [&](const Vector2d& x) {
      return 0.4 + sign * kSlope * std::max(std::abs(x.x() - 60.3), x.y() - 50.2);
    };
    for (const auto& w :
         {testing::DrawDepth(SmallCamera(), fold), testing::DrawDepth(SmallCamera(), corner)}) {
      const auto sample = SampleDepth(Image(w), {60.3, 50.2}, kSigma);
      ASSERT_TRUE(sample);
      // The error of a plane fit is 1.2 slopes at the fold and 1.4 at the corner.
      EXPECT_NEAR(sample->inverse_depth, 0.4, 0.7 * kSlope) << sign;
    }
  }
}

TEST(DepthSampler, SigmaIsConservative) {
  for (const double blur : {0.0, 1.5}) {
    cv::Mat depth = testing::DrawDepth(SmallCamera(), SlantedPlane);
    testing::AddInverseDepthNoise(kSigma, blur, 5, &depth);
    const auto image = Image(depth);
    double sum = 0.0;
    int count = 0;
    for (int y = 4; y < 116; y += 7) {
      for (int x = 4; x < 156; x += 7) {
        const Vector2d pixel(x + 0.3, y - 0.2);
        const auto sample = SampleDepth(image, pixel, kSigma);
        ASSERT_TRUE(sample);
        const double e = (sample->inverse_depth - SlantedPlane(pixel)) / sample->sigma;
        sum += e * e;
        ++count;
      }
    }
    EXPECT_LT(sum / count, 1.0) << blur;  // never overconfident
    EXPECT_GT(sum / count, blur > 0.0 ? 0.2 : 0.02) << blur;
  }
}

TEST(DepthSampler, SelectsNearerSurfaceAtDepthEdge) {
  const auto image = Image(testing::DrawDepth(SmallCamera(), StepAt60));
  // Within 1.5 px of the nearer surface, on either side of the edge.
  for (const double x : {58.6, 59.4, 60.2}) {
    const auto sample = SampleDepth(image, {x, 50.0}, kSigma);
    ASSERT_TRUE(sample) << x;
    EXPECT_NEAR(sample->inverse_depth, 1.0, 1e-6) << x;
    EXPECT_NEAR(sample->sigma, 0.3 * 0.5, 0.01) << x;
  }
  // Two pixels from the nearer surface, on the farther one.
  const auto beside = SampleDepth(image, {61.2, 50.0}, kSigma);
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->inverse_depth, 0.5, 1e-6);
  // Far from the edge, sigma is not inflated.
  EXPECT_LT(SampleDepth(image, {70.0, 50.0}, kSigma)->sigma, 1.3 * kSigma);
}

TEST(DepthSampler, InflatesSigmaByHeightOfDepthEdge) {
  for (const double far : {0.9, 0.7, 0.3}) {
    const auto image = Image(testing::DrawDepth(
        SmallCamera(), [far](const Vector2d& x) { return x.x() < 60.0 ? 1.0 : far; }));
    // The last position is on the farther surface: it is inflated too, because the point may belong
    // to the nearer one.
    for (const double x : {58.6, 60.2, 61.2}) {
      const auto sample = SampleDepth(image, {x, 50.0}, kSigma);
      ASSERT_TRUE(sample) << x;
      EXPECT_GT(sample->sigma, 0.2 * (1.0 - far)) << x;
      EXPECT_LT(sample->sigma, 0.5 * (1.0 - far)) << x;
    }
  }
}

TEST(DepthSampler, IgnoresMixedPixels) {
  // One column between the surfaces has a depth between theirs.
  const auto image = Image(testing::DrawDepth(SmallCamera(), [](const Vector2d& x) {
    if (x.x() == 60.0) return 0.65 + 0.01 * std::fmod(x.y(), 7.0);
    return StepAt60(x);
  }));
  const auto sample = SampleDepth(image, {60.0, 50.0}, kSigma);
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->inverse_depth, 1.0, 1e-6);
}

TEST(DepthSampler, IgnoresMissingPixels) {
  cv::Mat depth = testing::DrawDepth(SmallCamera(), SlantedPlane);
  depth.at<float>(50, 50) = 0.0f;
  depth.at<float>(50, 51) = std::numeric_limits<float>::quiet_NaN();
  const auto sample = SampleDepth(Image(depth), {50.0, 50.0}, kSigma);
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->inverse_depth, SlantedPlane({50.0, 50.0}), 1e-4);
}

TEST(DepthSampler, ReturnsNothingWithoutSurface) {
  cv::Mat depth = cv::Mat::zeros(120, 160, CV_32FC1);
  EXPECT_FALSE(SampleDepth(Image(depth), {50.0, 50.0}, kSigma));
  depth.at<float>(50, 50) = 1.0f;  // a single pixel
  EXPECT_FALSE(SampleDepth(Image(depth), {50.0, 50.0}, kSigma));
  depth.row(52).setTo(1.0f);  // a surface, but two pixels away
  depth.at<float>(50, 50) = 0.0f;
  EXPECT_FALSE(SampleDepth(Image(depth), {50.0, 50.0}, kSigma));
  EXPECT_FALSE(SampleDepth(Image(depth), {-50.0, 500.0}, kSigma));
  std::mt19937 random(3);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth.at<float>(y, x) = 1.0f / (0.15f + (random() % 1000) / 500.0f);
    }
  }
  int found = 0;
  const InverseDepthImage noise = Image(depth);
  for (int x = 5; x < 150; x += 5) found += SampleDepth(noise, {x + 0.0, 60.0}, kSigma).has_value();
  EXPECT_LE(found, 4);
}

}  // namespace
}  // namespace msc_vo
