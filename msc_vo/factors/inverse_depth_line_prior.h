// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Cholesky>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/inverse_depth_line.h"

namespace msc_vo {

/// Prior of an InverseDepthLine from the fit to its depth samples, 4 rows:
///
///   r = (L^-1 (w - w_0), a, c),   L L^T = covariance of the fit
///
/// w = (w_S, w_E): inverse depths, 1/metres; a, c: see InverseDepthLine (block 0, 4). w_0: inverse
/// depths of the fit. The full covariance lets structure correct the poorly determined combination
/// of the two inverse depths, usually their difference, and leaves well-fitted lines unchanged.
class InverseDepthLinePrior
    : public CostFunctor<InverseDepthLinePrior, 4, InverseDepthLine::kBlockSize> {
 public:
  explicit InverseDepthLinePrior(const LineDepth& depth)
      : mean_(depth.start, depth.end),
        root_information_(depth.covariance.llt().matrixL().solve(Eigen::Matrix2d::Identity())) {}

  template <typename T>
  bool operator()(const T* block, T* residuals) const {
    const T start = block[0] - mean_[0];
    const T end = block[1] - mean_[1];
    residuals[0] = root_information_(0, 0) * start;  // L^-1 is lower triangular
    residuals[1] = root_information_(1, 0) * start + root_information_(1, 1) * end;
    residuals[2] = block[2];
    residuals[3] = block[3];
    return true;
  }

 private:
  Eigen::Vector2d mean_;              // w_0
  Eigen::Matrix2d root_information_;  // L^-1, metres
};

}  // namespace msc_vo
