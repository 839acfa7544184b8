// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/estimate_covariance.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/pose_estimation/window_frame.h"
#include "tests/support/custom_pose_factors.h"
#include "tests/support/eigen_matchers.h"
#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include <Eigen/Cholesky>
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kNumWindows = 300;
// kNumWindows times the mean of chi-square with six degrees of freedom is chi-square, too: the
// 99.9 % interval of the mean is 6 +- 3.29 sqrt(2 * 6 / 300).
constexpr double kTolerance = 0.66;

TestWindowOptions FewFeatures(unsigned seed) {
  TestWindowOptions options;
  options.num_keyframes = 6;
  options.num_points = 60;
  options.num_lines = 0;
  options.seed = seed;
  return options;
}

// Squared error over the covariance: chi-square with six degrees of freedom if that is right.
double SquaredSigmas(const Rigid3& estimate, const Rigid3& truth, const PoseSummary& summary) {
  Vector6 error;
  Rigid3Manifold().Minus(estimate.params.data(), truth.params.data(), error.data());
  return error.dot(summary.covariance.ldlt().solve(error));
}

// Moves every point as `num_observations` measurements like that of the frame would: by their noise
// divided by the square root of their number.
void DisturbMap(const Rigid3& cam_from_world, double num_observations, std::mt19937* random,
                PoseData* data) {
  std::normal_distribution<double> normal(0.0, 1.0 / std::sqrt(num_observations));
  for (PoseData::Point& point : data->points) {
    const Eigen::Vector3d in_cam = cam_from_world * point.position;
    const double du = point.sigma * normal(*random);
    const double dv = point.sigma * normal(*random);
    const double inverse_depth = 1.0 / in_cam.z() + point.inverse_depth_sigma * normal(*random);
    const Eigen::Vector2d pixel = data->camera.Project(in_cam) + Eigen::Vector2d(du, dv);
    point.position =
        cam_from_world.Inverse() * (data->camera.BackProject(pixel, 1.0 / inverse_depth));
  }
}

double MeanSquaredSigmas(double num_observations, double map_variance) {
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kNumWindows; ++seed) {
    const TestWindow window = MakeTestWindow(FewFeatures(seed));
    const Rigid3 truth = Truth(window);
    std::mt19937 random(seed);
    PoseData data = MakePoseData(window, kFrame);
    DisturbMap(truth, num_observations, &random, &data);
    for (PoseData::Point& point : data.points) point.map_variance = map_variance;
    PoseOptions options;
    // The chi-square tests know nothing of the map's noise.
    options.reject_chi2_2 = options.reject_chi2_3 = 100.0;
    const PoseSummary summary = OptimizePose(options, &data);
    EXPECT_TRUE(summary.usable);
    sum += SquaredSigmas(data.cam_from_world, truth, summary);
  }
  return sum / kNumWindows;
}

TEST(CovarianceOfEstimate, ContainsTheUncertaintyOfTheMap) {
  EXPECT_NEAR(MeanSquaredSigmas(1.0, 1.0), 6.0, kTolerance);
  EXPECT_NEAR(MeanSquaredSigmas(4.0, 0.25), 6.0, kTolerance);
}

PoseSummary Optimize(const PoseData& data) {
  PoseData copy = data;
  return OptimizePose(PoseOptions(), &copy);
}

PoseData ExactMatches() {
  TestWindowOptions options = FewFeatures(1);
  options.num_lines = 10;
  options.noise = 0.0;
  return MakePoseData(MakeTestWindow(options), kFrame);
}

TEST(CovarianceOfEstimate, IsProportionalToOnePlusTheVarianceOfTheMap) {
  PoseData data = ExactMatches();
  const PoseCovariance exact_map = Optimize(data).covariance;
  for (auto& point : data.points) point.map_variance = 0.5;
  for (auto& line : data.lines) line.map_variance = 0.5;
  EXPECT_THAT(Optimize(data).covariance, IsNear(1.5 * exact_map, 1e-9));
}

TEST(CovarianceOfEstimate, GrowsWithTheResiduals) {
  PoseData exact = ExactMatches();
  exact.lines.clear();
  for (auto& point : exact.points) point.inverse_depth = 0.0;
  // To the left and to the right in turn, of which the pose absorbs little: three of five points by
  // 1.2 sigmas, the others by 2.2. The mean square is 2.8, that of two rows should be 2.
  PoseData noisy = exact;
  for (size_t i = 0; i < noisy.points.size(); ++i) {
    const double shift = (i % 5 < 3 ? 1.2 : 2.2) * (i % 2 == 0 ? 1.0 : -1.0);
    noisy.points[i].pixel.x() += shift * noisy.points[i].sigma;
  }
  const double ratio = Optimize(noisy).covariance.trace() / Optimize(exact).covariance.trace();
  EXPECT_NEAR(ratio, 1.4, 0.15);
}

// Three of five matches are off by eight sigmas, as in a blurred image. The others alone have no
// residuals.
constexpr double kShift = 8.0;
bool IsShifted(size_t i) { return i % 5 >= 2; }

template <typename Match>
std::vector<Match> Unshifted(const std::vector<Match>& matches) {
  std::vector<Match> unshifted;
  for (size_t i = 0; i < matches.size(); ++i) {
    if (!IsShifted(i)) unshifted.push_back(matches[i]);
  }
  return unshifted;
}

// To the left and to the right in turn.
PoseData BlurredPoints() {
  PoseData data = ExactMatches();
  data.lines.clear();
  double shift = kShift;
  for (size_t i = 0; i < data.points.size(); ++i) {
    if (!IsShifted(i)) continue;
    data.points[i].pixel.x() += shift * data.points[i].sigma;
    shift = -shift;
  }
  return data;
}

// The covariance of a frame with these matches over that with the unshifted ones alone.
double GrowthByOutliers(const PoseData& blurred) {
  PoseData unshifted = blurred;
  unshifted.points = Unshifted(blurred.points);
  unshifted.lines = Unshifted(blurred.lines);
  const PoseSummary all = Optimize(blurred);
  EXPECT_EQ(all.num_inliers.points, static_cast<int>(unshifted.points.size()));
  EXPECT_EQ(all.num_inliers.lines, static_cast<int>(unshifted.lines.size()));
  const PoseCovariance of_unshifted = Optimize(unshifted).covariance;
  const double growth = all.covariance.trace() / of_unshifted.trace();
  EXPECT_THAT(all.covariance, IsNear(growth * of_unshifted, 1e-6));
  return growth;
}

constexpr double kChiSquareMedian2 = 1.386;

TEST(CovarianceOfEstimate, GrowsWithTheResidualsOfOutliers) {
  EXPECT_NEAR(GrowthByOutliers(BlurredPoints()), kShift * kShift / kChiSquareMedian2, 1e-3);
}

TEST(CovarianceOfEstimate, GrowsWithTheResidualsOfLinesThatAreOutliers) {
  PoseData data = ExactMatches();
  data.points.clear();
  for (size_t i = 0; i < data.lines.size(); ++i) {
    if (!IsShifted(i)) continue;
    // Each end by kShift / sqrt(2) sigmas across the line.
    PoseData::Line& line = data.lines[i];
    const Eigen::Vector2d along = (line.segment.end - line.segment.start).normalized();
    const Eigen::Vector2d shift =
        kShift / std::sqrt(2.0) * line.sigma * Eigen::Vector2d(-along.y(), along.x());
    line.segment.start += shift;
    line.segment.end += shift;
  }
  // Sigmas grow where the map line extends beyond the observed segment.
  const double growth = GrowthByOutliers(data);
  EXPECT_LT(growth, kShift * kShift / kChiSquareMedian2);
  EXPECT_GT(growth, 0.5 * kShift * kShift / kChiSquareMedian2);
}

TEST(CovarianceOfEstimate, ExpectsLargerResidualsOfUncertainLandmarks) {
  PoseData data = BlurredPoints();
  for (size_t i = 0; i < data.points.size(); ++i) {
    if (IsShifted(i)) data.points[i].map_variance = 3.0;
  }
  EXPECT_NEAR(GrowthByOutliers(data), kShift * kShift / 4.0 / kChiSquareMedian2, 1e-3);
}

// At the true pose, from which these matches are marked as dynamic by hand.
PoseCovariance CovarianceWithDynamicMatches(PoseData data, bool shifted_are_dynamic) {
  const Rigid3 truth = Truth(MakeTestWindow(FewFeatures(1)));
  for (size_t i = 0; i < data.points.size(); ++i) {
    data.points[i].dynamic = shifted_are_dynamic && IsShifted(i);
  }
  const PoseOptions options;
  const PoseInlierMask mask = ClassifyMatches(options, data, truth);
  NormalEquations at_truth;
  EXPECT_TRUE(BuildFactors(options, data, mask, truth, false).Linearize(truth, &at_truth));
  return CovarianceOfEstimate(options, data, mask, truth, at_truth).value();
}

TEST(CovarianceOfEstimate, ExpectsNothingOfDynamicObjects) {
  PoseData unshifted = BlurredPoints();
  unshifted.points = Unshifted(unshifted.points);
  const PoseCovariance expected = CovarianceWithDynamicMatches(unshifted, false);
  EXPECT_THAT(CovarianceWithDynamicMatches(BlurredPoints(), true), IsNear(expected, 1e-9));
  EXPECT_GT(CovarianceWithDynamicMatches(BlurredPoints(), false).trace(), 2.0 * expected.trace());
}

TEST(CovarianceOfEstimate, DoesNotWeighCustomFactorsByResidualsOfMatches) {
  PoseData data = ExactMatches();
  data.points.clear();
  data.lines.clear();
  data.custom_factors = {PriorFactor("prior", data.cam_from_world, 0.01, 0.01)};
  const PoseCovariance covariance = Optimize(data).covariance;
  EXPECT_THAT(covariance, IsNear(1e-4 * PoseCovariance::Identity(), 1e-9));
}

TEST(CovarianceOfEstimate, RefusesVariancesThatAreNone) {
  for (const double variance : {-0.1, std::nan("")}) {
    PoseData data = ExactMatches();
    data.points[2].map_variance = variance;
    try {
      OptimizePose(PoseOptions(), &data);
      ADD_FAILURE() << variance;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), Names("point 2", "map_variance"));
    }
  }
}

}  // namespace
}  // namespace msc_vo
