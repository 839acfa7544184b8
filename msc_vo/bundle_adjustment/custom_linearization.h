// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres {
class CostFunction;
class LossFunction;
class Manifold;
}  // namespace ceres

namespace msc_vo {

/// A parameter block of a custom factor at its current value.
struct CustomParameter {
  const double* value = nullptr;
  int size = 0;                               ///< number of values
  const ceres::Manifold* manifold = nullptr;  ///< null: Euclidean
  bool variable = true;                       ///< whether derivatives by this block are needed
};

/// Residual and derivatives of a custom factor, multiplied by the square root of the weight that
/// its loss gives to the residual. A loss may ignore a residual (weight 0), but must not reward it:
/// negative weights count as 0.
struct CustomLinearization {
  double cost = 0.0;  ///< half the robust squared norm
  Eigen::VectorXd residual;
  /// Derivatives in the tangent space of each parameter block; empty for constant blocks.
  std::vector<Eigen::MatrixXd> jacobians;
};

/// Evaluates a custom factor. `loss`: null for none. Returns false if the cost function fails or
/// the cost, the residual or a derivative is not finite.
bool LinearizeCustomFactor(const ceres::CostFunction& cost, const ceres::LossFunction* loss,
                           const std::vector<CustomParameter>& parameters,
                           CustomLinearization* linearization);

/// Half the robust squared norm; NaN where the cost function fails or its residual is not finite.
double CustomFactorCost(const ceres::CostFunction& cost, const ceres::LossFunction* loss,
                        const std::vector<CustomParameter>& parameters);

/// Describes the first of these that is wrong: the cost function is null, it has no residuals, its
/// parameter blocks are not those of `parameters`, or LinearizeCustomFactor() fails. Empty if
/// nothing is wrong. `names`: one per parameter block, for the description.
std::string CustomFactorError(const ceres::CostFunction* cost, const ceres::LossFunction* loss,
                              const std::vector<CustomParameter>& parameters,
                              const std::vector<std::string>& names);

}  // namespace msc_vo
