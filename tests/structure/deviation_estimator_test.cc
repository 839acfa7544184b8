// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/deviation_estimator.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Angles of `count` lines: Gaussian deviations and measurements, in degrees; every tenth line leans
// by some degrees.
std::vector<DirectionDeviation> MakeDeviations(double deviation, double noise, int count,
                                               unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<DirectionDeviation> deviations;
  for (int i = 0; i < count; ++i) {
    const double sigma = std::hypot(i % 10 == 0 ? 3.0 : deviation, noise);
    const Eigen::Vector2d degrees{sigma * normal(random), sigma * normal(random)};
    deviations.push_back({DegreesToRadians(1.0) * degrees,
                          std::pow(DegreesToRadians(noise), 2) * Eigen::Matrix2d::Identity()});
  }
  return deviations;
}

double LearntDegrees(double deviation, double noise) {
  DeviationEstimator estimator;
  for (unsigned window = 0; window < 10; ++window) {
    estimator.Update(MakeDeviations(deviation, noise, 100, window));
  }
  return RadiansToDegrees(estimator.scale());
}

TEST(DeviationEstimator, LearnsTheDeviationBehindTheNoiseOfMeasurements) {
  // The scale of Student's distribution is near the standard deviation of its core.
  for (const double deviation : {0.05, 0.3, 1.0}) {
    EXPECT_NEAR(LearntDegrees(deviation, 0.02) / deviation, 1.0, 0.35) << deviation;
    EXPECT_NEAR(LearntDegrees(deviation, deviation) / deviation, 1.0, 0.5) << deviation;
  }
}

TEST(DeviationEstimator, StartsAtThePriorAndNeedsSeveralLinesToLeaveIt) {
  DeviationEstimator estimator;
  estimator.Update({});
  EXPECT_EQ(estimator.scale(), DeviationEstimator().scale());
  estimator.Update(MakeDeviations(0.05, 0.02, 1, 1));
  const double after_one = estimator.scale();
  estimator.Update(MakeDeviations(0.05, 0.02, 100, 2));
  EXPECT_LT(estimator.scale(), 0.5 * after_one);
}

TEST(DeviationEstimator, ForgetsOldWindows) {
  DeviationEstimator estimator;
  for (unsigned i = 0; i < 5; ++i) estimator.Update(MakeDeviations(1.0, 0.02, 100, i));
  for (unsigned i = 0; i < 5; ++i) estimator.Update(MakeDeviations(0.1, 0.02, 100, i));
  EXPECT_LT(RadiansToDegrees(estimator.scale()), 0.2);
}

TEST(DeviationEstimator, PullsLessOnLinesThatAreFarOff) {
  DeviationEstimator estimator;
  const double scale = estimator.scale();
  const auto at = [&](double sigmas) {
    return DirectionDeviation{{sigmas * scale, 0.0}, Eigen::Matrix2d::Zero()};
  };
  EXPECT_LT(estimator.Sigma(at(0.0)), scale);
  double last_force = 1e9;
  for (const double sigmas : {2.0, 4.0, 8.0, 16.0}) {
    const double sigma = estimator.Sigma(at(sigmas));
    const double force = sigmas * scale / (sigma * sigma);
    EXPECT_LT(force, last_force);
    last_force = force;
  }
}

TEST(DeviationEstimator, HasDensitiesThatIntegrateToOne) {
  DeviationEstimator estimator;
  const double variance = 0.25 * estimator.scale() * estimator.scale();
  const double step = 0.05 * estimator.scale();
  double line = 0.0, plane = 0.0;
  for (int i = -8000; i <= 8000; ++i) {
    line += step * estimator.Density(AngleDeviation{i * step, variance});
    // Rings of the plane.
    if (i < 0) continue;
    const double radius = (i + 0.5) * step;
    plane += 2.0 * kPi * radius * step *
             estimator.Density(
                 DirectionDeviation{{radius, 0.0}, variance * Eigen::Matrix2d::Identity()});
  }
  EXPECT_NEAR(line, 1.0, 0.001);
  EXPECT_NEAR(plane, 1.0, 0.001);
}

}  // namespace
}  // namespace msc_vo
