// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/estimate_covariance.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

namespace msc_vo {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The inverse, or std::nullopt if `hessian` is numerically singular. The test scales the diagonal
// to one, because radians and metres are not comparable; the eigenvalues are then at most 6, and a
// limit of 1e-10 leaves six digits above the rounding of the sums.
std::optional<Matrix6> Inverse(const Matrix6& hessian) {
  const Eigen::Matrix<double, 6, 1> diagonal = hessian.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::Matrix<double, 6, 1> scale = diagonal.cwiseSqrt().cwiseInverse();
  const Matrix6 scaled = scale.asDiagonal() * hessian * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scaled);
  if (!(eigen.eigenvalues()[0] > 1e-10)) return std::nullopt;
  const Matrix6 inverse = eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                          eigen.eigenvectors().transpose();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

// The matches without custom factors, weighted so that their Hessian is the sum of
// (1 + v) J^T S^-1 J.
PoseData WeightByMapVariance(const PoseData& data) {
  PoseData weighted = data;
  weighted.custom_factors.clear();
  ForEachLandmarkKind([&](auto kind) {
    for (auto& match : OfKind<typename decltype(kind)::Landmark>(weighted)) {
      WeightByMapVariance(&match);
    }
  });
  return weighted;
}

// Sum of the variances 1 + v of the residuals of the inliers.
double SumOfVariances(const PoseOptions& options, const PoseData& data,
                      const PoseInlierMask& mask) {
  double sum = 0.0;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& matches = OfKind<L>(data);
    for (size_t i = 0; i < matches.size(); ++i) {
      AddVariances(options, matches[i], mask.Of<L>()[i], &sum);
    }
  });
  return sum;
}

// Ratio of the squared residuals in the image of all matches, outliers included, to their
// expectation, by the median. Most matches of a blurred image fail the chi-square tests, and the
// others look too good.
double VarianceFactorOfAllMatches(const PoseOptions& options, const PoseData& data,
                                  const Rigid3& pose) {
  std::vector<double> chi2;
  chi2.reserve(Sum(SizesOf(data)));
  ForEachLandmarkKind([&](auto kind) {
    for (const auto& match : OfKind<typename decltype(kind)::Landmark>(data)) {
      if (match.dynamic || !HasReprojection(options, match)) continue;
      const double squared_sigmas = PixelChiSquare(data.camera, pose, match);
      if (std::isfinite(squared_sigmas))
        chi2.push_back(squared_sigmas / (1.0 + match.map_variance));
    }
  });
  return MedianChiSquareRatio(std::move(chi2));
}

}  // namespace

std::optional<PoseCovariance> CovarianceOfEstimate(const PoseOptions& options, const PoseData& data,
                                                   const PoseInlierMask& mask, const Rigid3& pose,
                                                   const NormalEquations& at_pose) {
  const std::optional<Matrix6> inverse = Inverse(at_pose.hessian);
  if (!inverse) return std::nullopt;
  NormalEquations of_matches = at_pose;
  if (!data.custom_factors.empty()) {
    PoseFactors factors = BuildFactors(options, data, mask, pose, false);
    factors.custom.clear();
    if (!factors.Linearize(pose, &of_matches)) return std::nullopt;
  }
  NormalEquations of_residuals;
  if (!BuildFactors(options, WeightByMapVariance(data), mask, pose, false)
           .Linearize(pose, &of_residuals)) {
    return std::nullopt;
  }
  // The estimate absorbs a part of the errors.
  const double expected =
      SumOfVariances(options, data, mask) - inverse->cwiseProduct(of_residuals.hessian).sum();
  double variance_factor = std::max(1.0, VarianceFactorOfAllMatches(options, data, pose));
  if (expected > 0.0) variance_factor = std::max(variance_factor, 2.0 * of_matches.cost / expected);
  const Matrix6 of_custom = at_pose.hessian - of_matches.hessian;
  return *inverse * (variance_factor * of_residuals.hessian + of_custom) * *inverse;
}

}  // namespace msc_vo
