// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/sized_cost_function.h>

#include "msc_vo/factors/line_pair_factor.h"

namespace msc_vo {

/// Ceres cost function of a LinePairFactor with analytic derivatives. For each line, with
/// v = E - S and unit direction d = v / |v|,
///
///   dr/dE = dr/dd dd/dv,  dr/dS = -dr/dE.
///
/// The Jacobian equals that of automatic differentiation.
template <typename Factor>
class AnalyticLinePairCostFunction final
    : public ceres::SizedCostFunction<Factor::kNumResiduals, 6, 6> {
 public:
  explicit AnalyticLinePairCostFunction(const Factor& factor) : factor_(factor) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Eigen::Vector3d d_i, d_j;
    if (!LineDirection(parameters[0], &d_i) || !LineDirection(parameters[1], &d_j)) return false;
    factor_.Residual(d_i, d_j, residuals);
    if (jacobians == nullptr) return true;
    Write(factor_.JacobianI(d_i, d_j), parameters[0], jacobians[0]);
    Write(factor_.JacobianJ(d_i, d_j), parameters[1], jacobians[1]);
    return true;
  }

 private:
  static void Write(const typename Factor::Jacobian& by_direction, const double* line,
                    double* jacobian) {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, Factor::kNumResiduals, 6, Eigen::RowMajor>> j(jacobian);
    j.template rightCols<3>() = by_direction * LineDirectionJacobian(line);
    j.template leftCols<3>() = -j.template rightCols<3>();
  }

  Factor factor_;
};

}  // namespace msc_vo
