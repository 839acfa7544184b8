// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/deviation_estimator.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Limits of the scale, degrees: below what a sensor can tell, and no structure any more.
constexpr double kSmallestScale = 0.02;
constexpr double kLargestScale = 4.0;
// Median of the prior of the deviation, radians. Floors and door frames are within 2 mm per metre
// (0.1 degrees), furniture and pictures within about one degree; sensors that bend surfaces add as
// much.
constexpr double kPrior = DegreesToRadians(0.7);
// Largest weight of earlier windows, as a number of angles. The relative standard deviation of the
// estimate is about 1 / sqrt(300) = 6 %.
constexpr double kMemory = 300.0;

Eigen::Matrix2d Total(const DirectionDeviation& deviation, double scale) {
  return deviation.covariance + scale * scale * Eigen::Matrix2d::Identity();
}

double ChiSquareAt(const DirectionDeviation& deviation, double scale) {
  return deviation.angle.dot(Total(deviation, scale).inverse() * deviation.angle);
}

// Logarithm of Student's density with two degrees of freedom in the plane, up to a constant.
double LogDensity(const DirectionDeviation& deviation, double scale) {
  return -0.5 * std::log(Total(deviation, scale).determinant()) -
         2.0 * std::log1p(0.5 * ChiSquareAt(deviation, scale));
}

}  // namespace

DeviationEstimator::DeviationEstimator() : scale_(kPrior) {
  const double step = std::log(kLargestScale / kSmallestScale) / (kNumScales - 1);
  for (int i = 0; i < kNumScales; ++i) {
    scales_[i] = DegreesToRadians(kSmallestScale * std::exp(step * i));
  }
}

void DeviationEstimator::Update(const std::vector<DirectionDeviation>& deviations) {
  if (deviations.empty()) return;
  AddLogLikelihoods(deviations);
  // Posterior mean over the grid; the prior is log-normal with a factor of e.
  Grid log_posterior;
  for (int i = 0; i < kNumScales; ++i) {
    const double ratio = std::log(scales_[i] / kPrior);
    log_posterior[i] = log_likelihoods_[i] - 0.5 * ratio * ratio;
  }
  const double largest = *std::max_element(log_posterior.begin(), log_posterior.end());
  double sum = 0.0, weighted = 0.0;
  for (int i = 0; i < kNumScales; ++i) {
    const double probability = std::exp(log_posterior[i] - largest);
    sum += probability;
    weighted += probability * scales_[i];
  }
  scale_ = weighted / sum;
}

// Earlier angles fade so that the total weight stays below the memory.
void DeviationEstimator::AddLogLikelihoods(const std::vector<DirectionDeviation>& deviations) {
  const double count = static_cast<double>(deviations.size());
  const double past = std::clamp(kMemory - count, 0.0, weight_);
  const double fading = weight_ > 0.0 ? past / weight_ : 0.0;
  const double share = std::min(1.0, kMemory / count);
  for (int i = 0; i < kNumScales; ++i) {
    double sum = 0.0;
    for (const DirectionDeviation& deviation : deviations) sum += LogDensity(deviation, scales_[i]);
    log_likelihoods_[i] = fading * log_likelihoods_[i] + share * sum;
  }
  weight_ = past + share * count;
}

double DeviationEstimator::ChiSquare(const DirectionDeviation& deviation) const {
  return ChiSquareAt(deviation, scale_);
}
double DeviationEstimator::ChiSquare(const AngleDeviation& deviation) const {
  return deviation.angle * deviation.angle / (deviation.variance + scale_ * scale_);
}

// Student's densities with two degrees of freedom, of two components and of one.
double DeviationEstimator::Density(const DirectionDeviation& deviation) const {
  return std::pow(1.0 + 0.5 * ChiSquare(deviation), -2.0) /
         (2.0 * kPi * std::sqrt(Total(deviation, scale_).determinant()));
}
double DeviationEstimator::Density(const AngleDeviation& deviation) const {
  return std::pow(1.0 + 0.5 * ChiSquare(deviation), -1.5) /
         std::sqrt(8.0 * (deviation.variance + scale_ * scale_));
}

// A Student variable with n degrees of freedom and p components is Gaussian with a random variance;
// its expected inverse, given the angle, is (n + p) / (n + chi-square).
double DeviationEstimator::Sigma(const DirectionDeviation& deviation) const {
  return scale_ * std::sqrt((2.0 + ChiSquare(deviation)) / 4.0);
}
double DeviationEstimator::Sigma(const AngleDeviation& deviation) const {
  return scale_ * std::sqrt((2.0 + ChiSquare(deviation)) / 3.0);
}

}  // namespace msc_vo
