// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_backprojection.h"

#include <cmath>

#include "tests/features/depth_images.h"
#include "tests/features/distortion.h"
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

constexpr double kDepthSigma = 1.425e-3;

PinholeCamera NarrowCamera() { return {480.0, 480.0, 159.5, 119.5, 320, 240}; }

// The segment used in all scenes; its direction is irrelevant here.
LineSegment2 Segment() { return {Vector2d(60.0, 90.0), Vector2d(180.0, 140.0)}; }

// Signed distance from the segment's line, pixels, positive below it.
double Below(const Vector2d& x) {
  return ImageLine(Segment()).dot(Eigen::Vector3d(x.x(), x.y(), 1));
}

double FrontPlane(const Vector2d& x) { return 0.4 + 0.0012 * x.x() + 0.0008 * x.y(); }

// The segment is the upper edge of a slanted plane in front of a wall 3.3 m away.
double OccludingEdge(const Vector2d& x) { return Below(x) > 0.0 ? FrontPlane(x) : 0.3; }

std::optional<LineDepth> Fit(const cv::Mat& depth, uint32_t seed = 1) {
  const LensRemap lens(NarrowCamera(), LensDistortion());
  return FitDepthAlongLine(InverseDepthImage(depth, 0.2, 10.0), lens, Segment(), kDepthSigma, seed);
}

std::optional<LineDepth> FromEndPoints(const cv::Mat& depth) {
  const LensRemap lens(NarrowCamera(), LensDistortion());
  return EndPointDepth(InverseDepthImage(depth, 0.2, 10.0), lens, Segment(), kDepthSigma);
}

// Largest error at the two end points relative to the slanted plane, in sigmas of a depth pixel.
double ErrorInSigmas(const LineDepth& depth) {
  return std::max(std::abs(depth.start - FrontPlane(Segment().start)),
                  std::abs(depth.end - FrontPlane(Segment().end))) /
         kDepthSigma;
}

TEST(LineBackprojection, IsExactOnPlane) {
  const auto depth = Fit(testing::DrawDepth(NarrowCamera(), FrontPlane));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 0.5);  // nearest pixels, no interpolation
  EXPECT_EQ(depth->inlier_ratio, 1.0);
  const auto ends = FromEndPoints(testing::DrawDepth(NarrowCamera(), FrontPlane));
  ASSERT_TRUE(ends);
  EXPECT_LT(ErrorInSigmas(*ends), 0.5);
  EXPECT_EQ(ends->covariance,
            Eigen::Matrix2d(Eigen::Matrix2d::Identity() * kDepthSigma * kDepthSigma));
}

TEST(LineBackprojection, IsUnbiasedAtFold) {
  // The intersection of two walls (concave) and the edge of a box (convex).
  for (const double slope : {2e-3, -2e-3}) {  // 1/metres per pixel
    double sum = 0.0;
    const int trials = 40;
    for (int trial = 0; trial < trials; ++trial) {
      cv::Mat scene = testing::DrawDepth(NarrowCamera(), [&](const Vector2d& x) {
        return FrontPlane(x) + slope * std::abs(Below(x));
      });
      testing::AddInverseDepthNoise(kDepthSigma, 1.5, trial + 1, &scene);
      const auto depth = Fit(scene, trial);
      ASSERT_TRUE(depth);
      const Vector2d middle = 0.5 * (Segment().start + Segment().end);
      sum += depth->At(0.5) - FrontPlane(middle);
    }
    // The error of the mean over the three middle pixels would be 0.7 slopes.
    EXPECT_LT(std::abs(sum / trials), 0.25 * std::abs(slope)) << slope;
  }
}

TEST(LineBackprojection, AssignsLineToOccludingSurface) {
  const auto depth = Fit(testing::DrawDepth(NarrowCamera(), OccludingEdge));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 1.0);
  EXPECT_GT(depth->inlier_ratio, 0.9);
  // Also if colour and depth are misaligned, in either direction.
  for (const double offset : {-1.5, 1.5}) {
    const auto misaligned = Fit(testing::DrawDepth(NarrowCamera(), [&](const Vector2d& x) {
      return Below(x) > offset ? FrontPlane(x) : 0.3;
    }));
    ASSERT_TRUE(misaligned) << offset;
    EXPECT_LT(ErrorInSigmas(*misaligned), 2.0) << offset;
  }
}

TEST(LineBackprojection, InflatesCovarianceBesideNearerSurface) {
  // Three rows of pixels are missing at the edge, so the line is assigned to the wall behind it.
  const auto depth = Fit(testing::DrawDepth(NarrowCamera(), [](const Vector2d& x) {
    return Below(x) > 0.0 && Below(x) < 3.0 ? 0.0 : OccludingEdge(x);
  }));
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->At(0.5), 0.3, 0.01);
  const Vector2d half(0.5, 0.5);
  const double gap = FrontPlane(0.5 * (Segment().start + Segment().end)) - 0.3;
  EXPECT_NEAR(std::sqrt(half.dot(depth->covariance * half)), 0.5 * gap, 0.05 * gap);
}

TEST(LineBackprojection, IsRobustToNoiseMixedAndMissingPixels) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    cv::Mat scene = testing::DrawDepth(NarrowCamera(), [&](const Vector2d& x) {
      const double mix = (random() % 1000) / 1000.0;
      if (std::abs(Below(x)) < 1.0) return mix * FrontPlane(x) + (1.0 - mix) * 0.3;
      if (random() % 4 == 0) return 0.0;  // missing
      return OccludingEdge(x);
    });
    testing::AddInverseDepthNoise(kDepthSigma, 0.0, seed + 100, &scene);
    const auto depth = Fit(scene, seed);
    ASSERT_TRUE(depth) << seed;
    EXPECT_LT(ErrorInSigmas(*depth), 4.0) << seed;
  }
}

TEST(LineBackprojection, IsRobustToPartialOcclusion) {
  // A post occludes a third of the line including an end point, which breaks EndPointDepth().
  const auto hidden = [](const Vector2d& x) {
    return x.x() > 145.0 && x.x() < 190.0 ? 1.5 : FrontPlane(x);
  };
  const auto depth = Fit(testing::DrawDepth(NarrowCamera(), hidden));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 2.0);
  EXPECT_NEAR(depth->inlier_ratio, 0.7, 0.05);
  const auto ends = FromEndPoints(testing::DrawDepth(NarrowCamera(), hidden));
  ASSERT_TRUE(ends);
  EXPECT_GT(ErrorInSigmas(*ends), 100.0);
}

TEST(LineBackprojection, FitsDepthWithMissingSamples) {
  // Depth is missing along the last two fifths, where extrapolation increases sigma.
  const auto scene = testing::DrawDepth(
      NarrowCamera(), [](const Vector2d& x) { return x.x() > 132.0 ? 0.0 : FrontPlane(x); });
  const auto depth = Fit(scene);
  ASSERT_TRUE(depth);
  // Without the error common to all samples, half a sigma.
  const auto own_sigma = [&](double s) {
    return std::sqrt(std::pow(depth->SigmaAt(s), 2) - std::pow(0.5 * kDepthSigma, 2));
  };
  EXPECT_GT(own_sigma(1.0), 2.0 * own_sigma(0.0));
  EXPECT_LT(std::abs(depth->end - FrontPlane(Segment().end)), 3.0 * depth->SigmaAt(1.0));
  EXPECT_FALSE(FromEndPoints(scene));
}

TEST(LineBackprojection, ReturnsNothingWithoutSurface) {
  EXPECT_FALSE(Fit(cv::Mat::zeros(240, 320, CV_32FC1)));
  EXPECT_FALSE(FromEndPoints(cv::Mat::zeros(240, 320, CV_32FC1)));
  std::mt19937 random(1);
  const auto noise = testing::DrawDepth(
      NarrowCamera(), [&](const Vector2d&) { return 0.2 + (random() % 1000) / 500.0; });
  EXPECT_FALSE(Fit(noise));
}

// Mean normalised estimation error squared of the fit over many noisy images with a common error of
// half a sigma; 2 if the covariance is consistent.
double MeanSquaredError(double blur) {
  const int trials = 150;
  double sum = 0.0;
  std::mt19937 random(1);
  std::normal_distribution<double> common(0.0, 0.5 * kDepthSigma);
  for (int trial = 0; trial < trials; ++trial) {
    cv::Mat scene = testing::DrawDepth(NarrowCamera(), OccludingEdge);
    testing::AddInverseDepthNoise(kDepthSigma, blur, trial + 1, &scene);
    const auto depth = Fit(scene, trial);
    if (!depth) return 1e9;
    const double shift = common(random);
    const Vector2d error(depth->start + shift - FrontPlane(Segment().start),
                         depth->end + shift - FrontPlane(Segment().end));
    sum += error.dot(depth->covariance.inverse() * error);
  }
  return sum / trials;
}

TEST(LineBackprojection, CovarianceIsConsistent) {
  // The standard deviation of the mean of 150 images is 0.16. Noise is correlated as for a depth
  // sensor.
  const double correlated = MeanSquaredError(1.5);
  EXPECT_GT(correlated, 1.2);
  EXPECT_LT(correlated, 3.0);
  // For white noise the covariance is conservative.
  const double white = MeanSquaredError(0.0);
  EXPECT_GT(white, 0.5);
  EXPECT_LT(white, 2.0);
}

TEST(EndPointDepth, UsesNearestValidPixelWithinRadius) {
  cv::Mat scene = cv::Mat::zeros(240, 320, CV_32FC1);
  scene.at<float>(92, 60) = 2.0f;    // 2 px from the start
  scene.at<float>(140, 181) = 4.0f;  // 1 px from the end
  scene.at<float>(142, 180) = 5.0f;  // 2 px: farther
  const auto ends = FromEndPoints(scene);
  ASSERT_TRUE(ends);
  EXPECT_FLOAT_EQ(ends->start, 0.5);
  EXPECT_FLOAT_EQ(ends->end, 0.25);
  scene.at<float>(92, 60) = 0.0f;
  scene.at<float>(92, 61) = 2.0f;  // 2.2 px
  EXPECT_FALSE(FromEndPoints(scene));
}

TEST(LineBackprojection, SamplesAlongDistortedLine) {
  // Lens distortion bends the line by several pixels. A straight path through the raw image would
  // sample both sides of the depth edge along the line.
  const PinholeCamera camera = testing::Freiburg1Camera();
  const LensDistortion distortion = testing::Freiburg1Distortion();
  const LineSegment2 segment{Vector2d(30.0, 25.0), Vector2d(610.0, 40.0)};
  const auto plane = [](const Vector2d& x) { return 0.5 + 0.0004 * x.x(); };
  const Eigen::Vector3d line = ImageLine(segment);
  const cv::Mat ideal = testing::DrawDepth(camera, [&](const Vector2d& x) {
    return line.dot(Eigen::Vector3d(x.x(), x.y(), 1.0)) > 0.0 ? plane(x) : 0.2;
  });
  const cv::Mat raw = testing::DistortImage(camera, distortion, ideal, cv::INTER_NEAREST);
  const LensRemap lens(camera, distortion);
  const auto depth =
      FitDepthAlongLine(InverseDepthImage(raw, 0.2, 10.0), lens, segment, kDepthSigma, 1);
  ASSERT_TRUE(depth);
  EXPECT_GT(depth->inlier_ratio, 0.95);
  EXPECT_NEAR(depth->start, plane(segment.start), 1.5e-3);
  EXPECT_NEAR(depth->end, plane(segment.end), 1.5e-3);
}

}  // namespace
}  // namespace msc_vo
