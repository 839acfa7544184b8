// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>

#include <ceres/sized_cost_function.h>

#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/robust_loss.h"

namespace msc_vo {

/// Ceres cost function of both factors of an observation, reprojection and depth, each with its own
/// Huber loss. Parameter blocks: cam_from_world (7), landmark (3 or 6).
///
/// Most of the time that Ceres takes for a small residual block does not depend on its size, so
/// that one block per observation is faster than two. As a block has one loss function at most, the
/// losses are applied here. With r_i the residual of factor i, s_i = |r_i|^2, and rho_i its loss,
/// the rows are
///
///   sqrt(rho_1'(s_1)) r_1,   sqrt(rho_2'(s_2)) r_2,   sqrt(sum_i rho_i(s_i) - rho_i'(s_i) s_i)
///
/// and the Jacobian is (sqrt(rho_1') dr_1, sqrt(rho_2') dr_2, 0). Half the squared norm of the rows
/// is the robust cost, J^T rows its gradient, and J^T J the approximation of the Hessian that Ceres
/// makes for a Huber loss: the steps are those of two residual blocks. The last row is zero unless
/// a residual is beyond its threshold.
///
/// The Jacobian is not the derivative of the rows: do not check it by differences, and add no loss
/// function.
template <typename Reprojection, typename Depth>
class ObservationCostFunction final
    : public ceres::SizedCostFunction<Reprojection::kNumResiduals + Depth::kNumResiduals + 1,
                                      Reprojection::kBlockSizes[0], Reprojection::kBlockSizes[1]> {
 public:
  ObservationCostFunction(const Reprojection& reprojection, const HuberLoss& reprojection_loss,
                          const Depth& depth, const HuberLoss& depth_loss)
      : reprojection_(reprojection),
        depth_(depth),
        reprojection_loss_(reprojection_loss),
        depth_loss_(depth_loss) {}

  bool Evaluate(double const* const* parameters, double* rows, double** jacobians) const override {
    double excess = 0.0;
    if (!EvaluateRows<0, Reprojection>(reprojection_, reprojection_loss_, parameters, rows,
                                       jacobians, &excess) ||
        !EvaluateRows<Reprojection::kNumResiduals, Depth>(depth_, depth_loss_, parameters, rows,
                                                          jacobians, &excess)) {
      return false;
    }
    if (!std::isfinite(excess)) return false;  // a squared norm overflows
    rows[kLastRow] = std::sqrt(std::max(0.0, excess));
    for (size_t i = 0; i < kBlockSizes.size() && jacobians != nullptr; ++i) {
      if (jacobians[i] == nullptr) continue;
      std::fill_n(jacobians[i] + kLastRow * kBlockSizes[i], kBlockSizes[i], 0.0);
    }
    return true;
  }

 private:
  static_assert(Reprojection::kBlockSizes[0] == Depth::kBlockSizes[0] &&
                Reprojection::kBlockSizes[1] == Depth::kBlockSizes[1]);
  static constexpr auto kBlockSizes = Reprojection::kBlockSizes;
  static constexpr int kLastRow = Reprojection::kNumResiduals + Depth::kNumResiduals;

  // Writes sqrt(rho') r and its Jacobian from `FirstRow` on, and adds rho - rho' s to *excess.
  template <int FirstRow, typename Factor>
  static bool EvaluateRows(const AnalyticCostFunction<Factor>& cost, const HuberLoss& loss,
                           double const* const* parameters, double* rows, double** jacobians,
                           double* excess) {
    constexpr int kRows = Factor::kNumResiduals;
    double* first_rows[kBlockSizes.size()] = {};
    for (size_t i = 0; i < kBlockSizes.size() && jacobians != nullptr; ++i) {
      if (jacobians[i] != nullptr) first_rows[i] = jacobians[i] + FirstRow * kBlockSizes[i];
    }
    Eigen::Map<Eigen::Matrix<double, kRows, 1>> residual(rows + FirstRow);
    if (!cost.Evaluate(parameters, residual.data(), jacobians == nullptr ? nullptr : first_rows)) {
      return false;
    }
    const double s = residual.squaredNorm();
    const double weight = loss.Weight(s);
    if (weight == 1.0) return true;
    *excess += loss.Cost(s) - weight * s;
    residual *= std::sqrt(weight);
    for (size_t i = 0; i < kBlockSizes.size(); ++i) {
      if (first_rows[i] == nullptr) continue;
      Eigen::Map<Eigen::VectorXd>(first_rows[i], kRows * kBlockSizes[i]) *= std::sqrt(weight);
    }
    return true;
  }

  AnalyticCostFunction<Reprojection> reprojection_;
  AnalyticCostFunction<Depth> depth_;
  HuberLoss reprojection_loss_, depth_loss_;
};

}  // namespace msc_vo
