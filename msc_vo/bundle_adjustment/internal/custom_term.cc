// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/custom_term.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ceres/manifold.h>

#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<const double*> ParametersOf(const CustomTerm::Block& block, const WindowState& state) {
  std::vector<const double*> parameters;
  parameters.reserve(block.parameters.size());
  for (const StateBlock& b : block.parameters) parameters.push_back(state.Block(b));
  return parameters;
}

// rho = (rho(s), rho'(s), rho''(s)) of the loss.
void EvaluateLoss(const CustomFactor& factor, double s, double* rho) {
  if (factor.loss) {
    factor.loss->Evaluate(s, rho);
  } else {
    rho[0] = s;
    rho[1] = 1.0;
    rho[2] = 0.0;
  }
}

// NaN where the factor is undefined.
double Cost(const CustomTerm::Block& block, const WindowState& state) {
  Eigen::VectorXd residual(block.factor->cost->num_residuals());
  if (!block.factor->cost->Evaluate(ParametersOf(block, state).data(), residual.data(), nullptr)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double rho[3];
  EvaluateLoss(*block.factor, residual.squaredNorm(), rho);
  return 0.5 * rho[0];
}

// Chain rule from the parameters of a block to its tangent space.
Eigen::MatrixXd InTangentSpace(const RowMajorMatrix& jacobian, const ceres::Manifold* manifold,
                               const double* parameters) {
  if (manifold == nullptr) return jacobian;
  RowMajorMatrix plus(manifold->AmbientSize(), manifold->TangentSize());
  manifold->PlusJacobian(parameters, plus.data());
  return jacobian * plus;
}

}  // namespace

double Cost(const CustomTerm& term, const WindowState& state) {
  double sum = 0.0;
  for (const CustomTerm::Block& block : term.blocks) sum += Cost(block, state);
  return sum;
}

bool Linearize(const CustomTerm::Block& block, const WindowState& state,
               const std::vector<bool>& variable, CustomLinearization* linearization) {
  const ceres::CostFunction& cost = *block.factor->cost;
  const size_t num_blocks = block.parameters.size();
  const std::vector<const double*> parameters = ParametersOf(block, state);
  std::vector<RowMajorMatrix> jacobians(num_blocks);
  std::vector<double*> jacobian_data(num_blocks, nullptr);
  for (size_t i = 0; i < num_blocks; ++i) {
    if (!variable[i]) continue;
    jacobians[i].resize(cost.num_residuals(), cost.parameter_block_sizes()[i]);
    jacobian_data[i] = jacobians[i].data();
  }
  linearization->residual.resize(cost.num_residuals());
  if (!cost.Evaluate(parameters.data(), linearization->residual.data(), jacobian_data.data())) {
    return false;
  }
  double rho[3];
  EvaluateLoss(*block.factor, linearization->residual.squaredNorm(), rho);
  linearization->cost = 0.5 * rho[0];
  // A loss may reject a residual altogether, but must not reward it.
  const double weight = std::sqrt(std::max(0.0, rho[1]));
  linearization->residual *= weight;
  linearization->jacobians.assign(num_blocks, Eigen::MatrixXd());
  bool finite = std::isfinite(rho[0]) && std::isfinite(weight);
  for (size_t i = 0; i < num_blocks; ++i) {
    if (!variable[i]) continue;
    linearization->jacobians[i] =
        weight * InTangentSpace(jacobians[i], state.ManifoldOf(block.parameters[i]), parameters[i]);
    finite = finite && linearization->jacobians[i].allFinite();
  }
  return finite;
}

std::string EvaluationError(const CustomTerm::Block& block, const WindowState& state,
                            const std::vector<bool>& variable) {
  CustomLinearization linearization;
  if (Linearize(block, state, variable, &linearization)) return "";
  return std::isfinite(Cost(block, state))
             ? "its derivatives are not finite at the initial values"
             : "it cannot be evaluated at the initial values: it returned false or a residual "
               "that is not finite";
}

}  // namespace msc_vo
