// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/custom_linearization.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>

namespace msc_vo {

namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Returns false if the cost function fails or its residual is not finite. `jacobians`: as for
// ceres::CostFunction::Evaluate.
bool EvaluateResidual(const ceres::CostFunction& cost,
                      const std::vector<CustomParameter>& parameters, double** jacobians,
                      Eigen::VectorXd* residual) {
  std::vector<const double*> values;
  values.reserve(parameters.size());
  for (const CustomParameter& parameter : parameters) values.push_back(parameter.value);
  residual->resize(cost.num_residuals());
  return cost.Evaluate(values.data(), residual->data(), jacobians) && residual->allFinite();
}

// Sets half the robust squared norm rho(s) and the weight rho'(s) of a residual, s = |r|^2.
void EvaluateLoss(const ceres::LossFunction* loss, const Eigen::VectorXd& residual, double* cost,
                  double* weight) {
  const double s = residual.squaredNorm();
  double rho[3] = {s, 1.0, 0.0};
  if (loss != nullptr) loss->Evaluate(s, rho);
  *cost = 0.5 * rho[0];
  *weight = std::max(0.0, rho[1]);
}

// Chain rule from the values of a block to its tangent space.
Eigen::MatrixXd InTangentSpace(const RowMajorMatrix& jacobian, const CustomParameter& parameter) {
  const ceres::Manifold* manifold = parameter.manifold;
  if (manifold == nullptr) return jacobian;
  RowMajorMatrix plus(manifold->AmbientSize(), manifold->TangentSize());
  manifold->PlusJacobian(parameter.value, plus.data());
  return jacobian * plus;
}

std::string BlocksError(const ceres::CostFunction& cost,
                        const std::vector<CustomParameter>& parameters,
                        const std::vector<std::string>& names) {
  const std::vector<int32_t>& sizes = cost.parameter_block_sizes();
  if (sizes.empty()) return "its cost function has no parameter blocks";
  if (sizes.size() != parameters.size()) {
    return "the number of parameter blocks of its cost function is " +
           std::to_string(sizes.size()) + " instead of " + std::to_string(parameters.size());
  }
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] == parameters[i].size) continue;
    return "its cost function has size " + std::to_string(sizes[i]) + " for parameter block " +
           std::to_string(i) + ", but " + names[i] + " has size " +
           std::to_string(parameters[i].size);
  }
  return "";
}

}  // namespace

bool LinearizeCustomFactor(const ceres::CostFunction& cost, const ceres::LossFunction* loss,
                           const std::vector<CustomParameter>& parameters,
                           CustomLinearization* linearization) {
  std::vector<RowMajorMatrix> jacobians(parameters.size());
  std::vector<double*> jacobian_data(parameters.size(), nullptr);
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].variable) continue;
    jacobians[i].resize(cost.num_residuals(), parameters[i].size);
    jacobian_data[i] = jacobians[i].data();
  }
  if (!EvaluateResidual(cost, parameters, jacobian_data.data(), &linearization->residual)) {
    return false;
  }
  double weight = 1.0;
  EvaluateLoss(loss, linearization->residual, &linearization->cost, &weight);
  const double root = std::sqrt(weight);
  linearization->residual *= root;
  linearization->jacobians.assign(parameters.size(), Eigen::MatrixXd());
  bool finite = std::isfinite(linearization->cost) && std::isfinite(root);
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].variable) continue;
    linearization->jacobians[i] = root * InTangentSpace(jacobians[i], parameters[i]);
    finite = finite && linearization->jacobians[i].allFinite();
  }
  return finite;
}

double CustomFactorCost(const ceres::CostFunction& cost, const ceres::LossFunction* loss,
                        const std::vector<CustomParameter>& parameters) {
  Eigen::VectorXd residual;
  if (!EvaluateResidual(cost, parameters, nullptr, &residual)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double robust = 0.0, weight = 1.0;
  EvaluateLoss(loss, residual, &robust, &weight);
  return robust;
}

std::string CustomFactorError(const ceres::CostFunction* cost, const ceres::LossFunction* loss,
                              const std::vector<CustomParameter>& parameters,
                              const std::vector<std::string>& names) {
  if (cost == nullptr) return "its cost function is null";
  if (cost->num_residuals() < 1) return "its cost function has no residuals";
  std::string error = BlocksError(*cost, parameters, names);
  if (!error.empty()) return error;
  CustomLinearization linearization;
  if (LinearizeCustomFactor(*cost, loss, parameters, &linearization)) return "";
  return std::isfinite(CustomFactorCost(*cost, loss, parameters))
             ? "its derivatives are not finite at the initial values"
             : "it cannot be evaluated at the initial values: it returned false or a residual "
               "that is not finite";
}

}  // namespace msc_vo
