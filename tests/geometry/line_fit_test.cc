// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_fit.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

constexpr double kSigma = 1.4e-3;

// n samples of the line with inverse depths `start` and `end` (1/metres) and noise of `noise`
// sigmas.
std::vector<LineFitSample> Samples(int n, double start, double end, double noise,
                                   std::mt19937* random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<LineFitSample> samples;
  for (int i = 0; i < n; ++i) {
    const double s = static_cast<double>(i) / (n - 1);
    samples.push_back({s, (1.0 - s) * start + s * end + noise * kSigma * normal(*random), kSigma});
  }
  return samples;
}

TEST(LineFit, IsExactWithoutNoise) {
  std::mt19937 random(1);
  const auto depth = FitLineDepth(Samples(12, 0.5, 0.7, 0.0, &random), 3);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->start, 0.5, 1e-12);
  EXPECT_NEAR(depth->end, 0.7, 1e-12);
  EXPECT_EQ(depth->num_inliers, 12);
  EXPECT_EQ(depth->inlier_ratio, 1.0);
}

TEST(LineFit, CovarianceMatchesLeastSquares) {
  // Three samples of sigma q at each end: standard deviation q / sqrt(3) at each end, independent.
  const double q = 2e-3;
  std::vector<LineFitSample> samples;
  for (const double s : {0.0, 0.0, 0.0, 1.0, 1.0, 1.0}) samples.push_back({s, 0.4, q});
  const auto depth = FitLineDepth(samples, 0);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->covariance(0, 0), q * q / 3.0, 1e-15);
  EXPECT_NEAR(depth->covariance(1, 1), q * q / 3.0, 1e-15);
  EXPECT_NEAR(depth->covariance(0, 1), 0.0, 1e-15);
}

TEST(LineFit, IsRobustToOutliers) {
  std::mt19937 random(2);
  for (uint32_t seed = 0; seed < 50; ++seed) {
    std::vector<LineFitSample> samples = Samples(30, 0.5, 0.8, 1.0, &random);
    for (size_t i = 0; i < samples.size(); i += 3) samples[i].inverse_depth = 0.2 + 0.02 * (i % 7);
    const auto depth = FitLineDepth(samples, seed);
    ASSERT_TRUE(depth) << seed;
    EXPECT_NEAR(depth->start, 0.5, 4.5 * std::sqrt(depth->covariance(0, 0))) << seed;
    EXPECT_NEAR(depth->end, 0.8, 4.5 * std::sqrt(depth->covariance(1, 1))) << seed;
    EXPECT_GE(depth->num_inliers, 17) << seed;
    EXPECT_LE(depth->num_inliers, 20) << seed;
  }
}

TEST(LineFit, CovarianceIsConsistent) {
  // The normalised squared error of the two inverse depths is chi-square distributed with two
  // degrees of freedom: mean 2, standard deviation of the mean of 1000 trials 2 / sqrt(1000) =
  // 0.063. The 99 % inlier test removes a little noise, hence the wider upper bound.
  std::mt19937 random(3);
  const int trials = 1000;
  double sum = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto depth = FitLineDepth(Samples(20, 0.9, 0.4, 1.0, &random), trial);
    ASSERT_TRUE(depth);
    const Eigen::Vector2d error(depth->start - 0.9, depth->end - 0.4);
    sum += error.dot(depth->covariance.inverse() * error);
  }
  EXPECT_GT(sum / trials, 1.8);
  EXPECT_LT(sum / trials, 2.5);
}

TEST(LineFit, RejectsSamplesWithoutLine) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.2, 2.0);
  std::vector<LineFitSample> noise;
  for (int i = 0; i < 40; ++i) noise.push_back({i / 39.0, uniform(random), kSigma});
  EXPECT_FALSE(FitLineDepth(noise, 1));
  EXPECT_FALSE(FitLineDepth({}, 1));
  EXPECT_FALSE(FitLineDepth(Samples(4, 0.5, 0.5, 0.0, &random), 1));  // five are required
  // All samples at one position.
  EXPECT_FALSE(FitLineDepth(std::vector<LineFitSample>(9, {0.5, 0.5, kSigma}), 1));
}

TEST(LineFit, RejectsLineBehindCamera) {
  std::vector<LineFitSample> samples;
  for (int i = 0; i < 10; ++i) samples.push_back({0.05 * i, 0.5 - 0.06 * i, kSigma});
  EXPECT_FALSE(FitLineDepth(samples, 1));  // w(1) = -0.7
}

TEST(LineFit, IsDeterministic) {
  std::mt19937 random(5);
  std::vector<LineFitSample> samples = Samples(60, 0.5, 0.8, 3.0, &random);
  const auto a = FitLineDepth(samples, 11);
  const auto b = FitLineDepth(samples, 11);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->start, b->start);
  EXPECT_EQ(a->end, b->end);
  EXPECT_EQ(a->covariance, b->covariance);
}

TEST(LineFit, BackProjectInvertsProjection) {
  PinholeCamera camera;
  camera.fy = -camera.fy;
  const LineSegment3 truth{Eigen::Vector3d(-0.4, 0.2, 1.5), Eigen::Vector3d(0.5, -0.1, 3.0)};
  const LineSegment2 image{camera.Project(truth.start), camera.Project(truth.end)};
  LineDepth depth;
  depth.start = 1.0 / truth.start.z();
  depth.end = 1.0 / truth.end.z();
  const LineSegment3 segment = BackProject(camera, image, depth);
  EXPECT_LT((segment.start - truth.start).norm(), 1e-12);
  EXPECT_LT((segment.end - truth.end).norm(), 1e-12);
  // Inverse depth is linear along the image segment.
  const Eigen::Vector3d middle = camera.BackProject(image.Midpoint(), 1.0 / depth.At(0.5));
  EXPECT_LT(truth.DistanceToLine(middle), 1e-12);
}

TEST(LineFit, DirectionSigmaMatchesSimulation) {
  const PinholeCamera camera;
  const LineSegment2 image{Eigen::Vector2d(200, 150), Eigen::Vector2d(300, 260)};
  LineDepth depth;
  depth.start = 0.5;
  depth.end = 0.65;
  depth.covariance << 4e-6, -1e-6, -1e-6, 2e-6;
  const Eigen::Vector3d mean = BackProject(camera, image, depth).Direction();
  const Eigen::Matrix2d root = depth.covariance.llt().matrixL();
  std::mt19937 random(6);
  std::normal_distribution<double> normal(0.0, 1.0);
  const int trials = 4000;
  double sum = 0.0;
  for (int i = 0; i < trials; ++i) {
    const double a = normal(random);
    const double b = normal(random);
    const Eigen::Vector2d noise = root * Eigen::Vector2d(a, b);
    LineDepth noisy = depth;
    noisy.start += noise[0];
    noisy.end += noise[1];
    const double angle = UndirectedAngle(mean, BackProject(camera, image, noisy).Direction());
    sum += angle * angle;
  }
  const double sigma = DirectionSigma(camera, image, depth);
  EXPECT_NEAR(std::sqrt(sum / trials) / sigma, 1.0, 0.05);
}

TEST(LineDepth, NearerShiftsBothEndsByOffset) {
  LineDepth depth;
  depth.start = 1.0 / 2.0;
  depth.end = 1.0 / 3.0;
  depth.covariance.setIdentity();
  const LineDepth nearer = Nearer(depth, 0.01);
  EXPECT_NEAR(1.0 / nearer.start, 1.99, 1e-12);
  EXPECT_NEAR(1.0 / nearer.end, 2.99, 1e-12);
  EXPECT_EQ(nearer.covariance, depth.covariance);
}

}  // namespace
}  // namespace msc_vo
