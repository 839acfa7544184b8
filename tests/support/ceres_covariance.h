// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <ceres/covariance.h>
#include <gtest/gtest.h>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"
#include "msc_vo/bundle_adjustment/window_covariance.h"
#include "msc_vo/bundle_adjustment/window_problem.h"

namespace msc_vo {

template <typename Items>
std::vector<int64_t> Ids(const Items& items) {
  std::vector<int64_t> ids;
  for (const auto& item : items) ids.push_back(item.id);
  return ids;
}

inline CovarianceSelection AllItems(const WindowData& data) {
  return {Ids(data.keyframes), Ids(data.points), Ids(data.lines)};
}

// Covariances of the same factors by Ceres.
class CeresCovariance {
 public:
  CeresCovariance(const BundleAdjustmentOptions& options, const WindowData& data) : state_(data) {
    const WindowIndex index = ValidateWindow(options, data);
    const WindowInlierMask inlier_mask = UnrejectedInlierMask(options, index, data);
    WindowData with_uncertainty = data;
    AddNoiseUncertainty(options.landmark_noise, index, inlier_mask, state_, &with_uncertainty);
    terms_ = MakeWindowTerms(options, with_uncertainty, index, inlier_mask, state_);
    window_ = std::make_unique<WindowProblem>(options, data, terms_, &state_);
    ceres::Covariance::Options covariance_options;
    covariance_options.algorithm_type = ceres::SPARSE_QR;
    covariance_options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    covariance_ = std::make_unique<ceres::Covariance>(covariance_options);
    std::vector<std::pair<const double*, const double*>> blocks;
    const auto add = [&](const double* block) {
      if (Contains(block)) blocks.push_back({block, block});
    };
    for (size_t i = 0; i < data.keyframes.size(); ++i) add(state_.PoseBlock(i));
    for (size_t i = 0; i < data.points.size(); ++i) add(state_.PointBlock(i));
    for (size_t i = 0; i < data.lines.size(); ++i) add(state_.LineBlock(i));
    for (size_t i = 0; i < state_.NumExtra(); ++i) add(state_.ExtraBlock(i));
    EXPECT_TRUE(covariance_->Compute(blocks, window_->problem()));
  }
  // Whether a factor depends on the block.
  bool Contains(const double* block) const { return window_->problem()->HasParameterBlock(block); }
  // N: degrees of freedom of the block.
  template <int N>
  Eigen::Matrix<double, N, N> Of(const double* block) const {
    Eigen::Matrix<double, N, N> matrix;  // symmetric, so the storage order does not matter
    EXPECT_TRUE(covariance_->GetCovarianceBlockInTangentSpace(block, block, matrix.data()));
    return matrix;
  }
  WindowState state_;

 private:
  WindowTerms terms_;
  std::unique_ptr<WindowProblem> window_;
  std::unique_ptr<ceres::Covariance> covariance_;
};

// Errors relative to the standard deviations of the parameters.
template <typename Matrix>
void ExpectSameCovariance(const std::optional<Matrix>& found, const Matrix& expected) {
  ASSERT_TRUE(found.has_value());
  const auto sigma = expected.diagonal().cwiseSqrt().eval();
  const Matrix scale = sigma * sigma.transpose();
  EXPECT_LT((*found - expected).cwiseQuotient(scale).cwiseAbs().maxCoeff(), 1e-5)
      << *found << "\n\n"
      << expected;
}

}  // namespace msc_vo
