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

constexpr double kSigma = 1.425e-3;

PinholeCamera Camera() { return {480.0, 480.0, 159.5, 119.5, 320, 240}; }

// The segment that all scenes are looked at along; bright and dark do not matter here.
LineSegment2 Segment() { return {Vector2d(60.0, 90.0), Vector2d(180.0, 140.0)}; }

// Pixels from the segment's line, positive below it.
double Below(const Vector2d& x) {
  return ImageLine(Segment()).dot(Eigen::Vector3d(x.x(), x.y(), 1));
}

double SlantedPlane(const Vector2d& x) { return 0.4 + 0.0012 * x.x() + 0.0008 * x.y(); }

// The segment is the upper edge of a slanted plane; the wall behind it is 3.3 m away.
double OccludingEdge(const Vector2d& x) { return Below(x) > 0.0 ? SlantedPlane(x) : 0.3; }

std::optional<LineDepth> Fit(const cv::Mat& depth, uint32_t seed = 1) {
  const LensRemap lens(Camera(), LensDistortion());
  return FitDepthAlongLine({}, InverseDepthImage(depth, 0.2, 10.0), lens, Segment(), kSigma, seed);
}

std::optional<LineDepth> Naive(const cv::Mat& depth) {
  const LensRemap lens(Camera(), LensDistortion());
  return EndPointDepth(InverseDepthImage(depth, 0.2, 10.0), lens, Segment(), kSigma);
}

// Deviation from the slanted plane at the worse end, in sigmas of a depth pixel.
double ErrorInSigmas(const LineDepth& depth) {
  return std::max(std::abs(depth.start - SlantedPlane(Segment().start)),
                  std::abs(depth.end - SlantedPlane(Segment().end))) /
         kSigma;
}

TEST(LineBackprojection, IsExactOnAPlane) {
  const auto depth = Fit(testing::DrawDepth(Camera(), SlantedPlane));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 0.5);  // nearest pixels, no interpolation
  EXPECT_EQ(depth->inlier_ratio, 1.0);
  const auto naive = Naive(testing::DrawDepth(Camera(), SlantedPlane));
  ASSERT_TRUE(naive);
  EXPECT_LT(ErrorInSigmas(*naive), 0.5);
  EXPECT_EQ(naive->covariance, Eigen::Matrix2d(Eigen::Matrix2d::Identity() * kSigma * kSigma));
}

TEST(LineBackprojection, IsNotPulledByAFold) {
  // The line where two walls meet (farthest there), and the edge of a box (nearest there).
  for (const double slope : {2e-3, -2e-3}) {  // 1/metres per pixel
    double sum = 0.0;
    const int trials = 40;
    for (int trial = 0; trial < trials; ++trial) {
      cv::Mat scene = testing::DrawDepth(Camera(), [&](const Vector2d& x) {
        return SlantedPlane(x) + slope * std::abs(Below(x));
      });
      testing::AddInverseDepthNoise(kSigma, 1.5, trial + 1, &scene);
      const auto depth = Fit(scene, trial);
      ASSERT_TRUE(depth);
      const Vector2d middle = 0.5 * (Segment().start + Segment().end);
      sum += depth->At(0.5) - SlantedPlane(middle);
    }
    // The three pixels in the middle are 0.7 slopes away in the mean.
    EXPECT_LT(std::abs(sum / trials), 0.25 * std::abs(slope)) << slope;
  }
}

TEST(LineBackprojection, BelongsToTheSurfaceThatOccludes) {
  const auto depth = Fit(testing::DrawDepth(Camera(), OccludingEdge));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 1.0);
  EXPECT_GT(depth->inlier_ratio, 0.9);
  // Also when colour and depth are not aligned to the pixel, either way.
  for (const double offset : {-1.5, 1.5}) {
    const auto misaligned = Fit(testing::DrawDepth(
        Camera(), [&](const Vector2d& x) { return Below(x) > offset ? SlantedPlane(x) : 0.3; }));
    ASSERT_TRUE(misaligned) << offset;
    EXPECT_LT(ErrorInSigmas(*misaligned), 2.0) << offset;
  }
}

TEST(LineBackprojection, DoubtsItsDepthBesideANearerSurface) {
  // Three rows of pixels are missing at the edge, so that the line has the depth of the wall.
  const auto depth = Fit(testing::DrawDepth(Camera(), [](const Vector2d& x) {
    return Below(x) > 0.0 && Below(x) < 3.0 ? 0.0 : OccludingEdge(x);
  }));
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->At(0.5), 0.3, 0.01);
  const Vector2d half(0.5, 0.5);
  const double gap = SlantedPlane(0.5 * (Segment().start + Segment().end)) - 0.3;
  EXPECT_NEAR(std::sqrt(half.dot(depth->covariance * half)), 0.5 * gap, 0.05 * gap);
}

TEST(LineBackprojection, SurvivesNoiseMixedPixelsAndHoles) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    cv::Mat scene = testing::DrawDepth(Camera(), [&](const Vector2d& x) {
      const double share = (random() % 1000) / 1000.0;
      if (std::abs(Below(x)) < 1.0) return share * SlantedPlane(x) + (1.0 - share) * 0.3;  // mixed
      if (random() % 4 == 0) return 0.0;  // missing
      return OccludingEdge(x);
    });
    testing::AddInverseDepthNoise(kSigma, 0.0, seed + 100, &scene);
    const auto depth = Fit(scene, seed);
    ASSERT_TRUE(depth) << seed;
    EXPECT_LT(ErrorInSigmas(*depth), 4.0) << seed;
  }
}

TEST(LineBackprojection, SurvivesSomethingInFront) {
  // A post hides a third of the line; the naive variant breaks where it covers an end point.
  const auto hidden = [](const Vector2d& x) {
    return x.x() > 145.0 && x.x() < 190.0 ? 1.5 : SlantedPlane(x);
  };
  const auto depth = Fit(testing::DrawDepth(Camera(), hidden));
  ASSERT_TRUE(depth);
  EXPECT_LT(ErrorInSigmas(*depth), 2.0);
  EXPECT_NEAR(depth->inlier_ratio, 0.7, 0.05);
  const auto naive = Naive(testing::DrawDepth(Camera(), hidden));
  ASSERT_TRUE(naive);
  EXPECT_GT(ErrorInSigmas(*naive), 100.0);
}

TEST(LineBackprojection, UsesTheDepthThatThereIs) {
  // None in the last two fifths, where the line is extrapolated and its sigma says so.
  const auto scene = testing::DrawDepth(
      Camera(), [](const Vector2d& x) { return x.x() > 132.0 ? 0.0 : SlantedPlane(x); });
  const auto depth = Fit(scene);
  ASSERT_TRUE(depth);
  // All samples have half a sigma in common besides.
  const auto own_sigma = [&](double s) {
    return std::sqrt(std::pow(depth->SigmaAt(s), 2) - std::pow(0.5 * kSigma, 2));
  };
  EXPECT_GT(own_sigma(1.0), 2.0 * own_sigma(0.0));
  EXPECT_LT(std::abs(depth->end - SlantedPlane(Segment().end)), 3.0 * depth->SigmaAt(1.0));
  EXPECT_FALSE(Naive(scene));
}

TEST(LineBackprojection, HasNothingWithoutDepth) {
  EXPECT_FALSE(Fit(cv::Mat::zeros(240, 320, CV_32FC1)));
  EXPECT_FALSE(Naive(cv::Mat::zeros(240, 320, CV_32FC1)));
  std::mt19937 random(1);
  const auto noise = testing::DrawDepth(
      Camera(), [&](const Vector2d&) { return 0.2 + (random() % 1000) / 500.0; });
  EXPECT_FALSE(Fit(noise));
}

// Mean normalised squared error of the fit over many noisy images, whose pixels have half a sigma
// in common besides; 2 if the covariance is right.
double MeanSquaredError(double blur) {
  const int trials = 150;
  double sum = 0.0;
  std::mt19937 random(1);
  std::normal_distribution<double> common(0.0, 0.5 * kSigma);
  for (int trial = 0; trial < trials; ++trial) {
    cv::Mat scene = testing::DrawDepth(Camera(), OccludingEdge);
    testing::AddInverseDepthNoise(kSigma, blur, trial + 1, &scene);
    const auto depth = Fit(scene, trial);
    if (!depth) return 1e9;
    const double shift = common(random);
    const Vector2d error(depth->start + shift - SlantedPlane(Segment().start),
                         depth->end + shift - SlantedPlane(Segment().end));
    sum += error.dot(depth->covariance.inverse() * error);
  }
  return sum / trials;
}

TEST(LineBackprojection, CovarianceIsConsistent) {
  // The mean of 150 has a standard deviation of 0.16. Noise as correlated as a depth sensor's:
  const double correlated = MeanSquaredError(1.5);
  EXPECT_GT(correlated, 1.2);
  EXPECT_LT(correlated, 3.0);
  // White noise is less than what the covariance allows for.
  const double white = MeanSquaredError(0.0);
  EXPECT_GT(white, 0.5);
  EXPECT_LT(white, 2.0);
}

TEST(LineBackprojection, NaiveTakesTheNearestPixelWithinReach) {
  cv::Mat scene = cv::Mat::zeros(240, 320, CV_32FC1);
  scene.at<float>(92, 60) = 2.0f;    // 2 px from the start
  scene.at<float>(140, 181) = 4.0f;  // 1 px from the end
  scene.at<float>(142, 180) = 5.0f;  // 2 px: farther
  const auto naive = Naive(scene);
  ASSERT_TRUE(naive);
  EXPECT_FLOAT_EQ(naive->start, 0.5);
  EXPECT_FLOAT_EQ(naive->end, 0.25);
  scene.at<float>(92, 60) = 0.0f;
  scene.at<float>(92, 61) = 2.0f;  // 2.2 px
  EXPECT_FALSE(Naive(scene));
}

TEST(LineBackprojection, FollowsTheLens) {
  // The plane is seen through a lens that bends the line by several pixels; it has a step along the
  // line, so that a straight path through the raw image would sample both sides.
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
      FitDepthAlongLine({}, InverseDepthImage(raw, 0.2, 10.0), lens, segment, kSigma, 1);
  ASSERT_TRUE(depth);
  EXPECT_GT(depth->inlier_ratio, 0.95);
  EXPECT_NEAR(depth->start, plane(segment.start), 1.5e-3);
  EXPECT_NEAR(depth->end, plane(segment.end), 1.5e-3);
}

}  // namespace
}  // namespace msc_vo
