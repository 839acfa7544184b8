// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <ceres/gradient_checker.h>
#include <ceres/manifold.h>

namespace msc_vo {

/// Result of CheckJacobians().
struct JacobianCheck {
  /// Largest difference between an entry of the Jacobians and its numeric derivative, divided by 1
  /// plus the norm of the Jacobian of that parameter block. Infinite if the cost function returns
  /// false or a number that is not finite, at the parameters or near them.
  double deviation = 0.0;
  /// The parameter block with the largest deviation and its two Jacobians, for the message of a
  /// test. Empty if the deviation is zero.
  std::string report;
};

/// Compares the Jacobians of a cost function with central differences (Ridders' method), in the
/// tangent spaces of the manifolds. The deviation of correct derivatives is below 1e-7. Call it at
/// several parameters, including those where the residual is zero.
///
///   const Rigid3Manifold pose;
///   EXPECT_LT(CheckJacobians(cost, {block_0, block_1}, {&pose, nullptr}).deviation, 1e-7);
///
/// `parameters`: values of the parameter blocks in the order of the cost function. `manifolds`: one
/// per block; null: Euclidean.
/// Throws std::invalid_argument if the number of blocks or manifolds, or the size of a block, does
/// not fit the cost function.
JacobianCheck CheckJacobians(const ceres::CostFunction& cost,
                             const std::vector<std::vector<double>>& parameters,
                             const std::vector<const ceres::Manifold*>& manifolds);

/// \cond
namespace jacobian_check_internal {

inline void CheckSizes(const ceres::CostFunction& cost,
                       const std::vector<std::vector<double>>& parameters,
                       const std::vector<const ceres::Manifold*>& manifolds) {
  const std::vector<int>& sizes = cost.parameter_block_sizes();
  const auto fail = [](const std::string& what, size_t is, size_t expected) {
    throw std::invalid_argument("CheckJacobians: " + what + " is " + std::to_string(is) +
                                "; the cost function requires " + std::to_string(expected));
  };
  if (parameters.size() != sizes.size()) {
    fail("the number of parameter blocks", parameters.size(), sizes.size());
  }
  if (manifolds.size() != sizes.size()) {
    fail("the number of manifolds", manifolds.size(), sizes.size());
  }
  for (size_t i = 0; i < sizes.size(); ++i) {
    const size_t size = static_cast<size_t>(sizes[i]);
    const std::string block = " of block " + std::to_string(i);
    if (parameters[i].size() != size) fail("the size" + block, parameters[i].size(), size);
    if (!manifolds[i]) continue;
    const size_t ambient = static_cast<size_t>(manifolds[i]->AmbientSize());
    if (ambient != size) fail("the ambient size of the manifold" + block, ambient, size);
  }
}

// Records the deviation of one block if it is the largest so far.
inline void Compare(size_t block, const Eigen::MatrixXd& analytic, const Eigen::MatrixXd& numeric,
                    JacobianCheck* check) {
  double deviation = (analytic - numeric).cwiseAbs().maxCoeff() / (1.0 + analytic.norm());
  if (!analytic.allFinite() || !numeric.allFinite()) {
    deviation = std::numeric_limits<double>::infinity();
  }
  if (!(deviation > check->deviation)) return;
  std::ostringstream report;
  report.imbue(std::locale::classic());
  report << "parameter block " << block << ": deviation " << deviation << "\nJacobian:\n"
         << analytic << "\nnumeric derivative:\n"
         << numeric;
  *check = {deviation, report.str()};
}

}  // namespace jacobian_check_internal
/// \endcond

inline JacobianCheck CheckJacobians(const ceres::CostFunction& cost,
                                    const std::vector<std::vector<double>>& parameters,
                                    const std::vector<const ceres::Manifold*>& manifolds) {
  jacobian_check_internal::CheckSizes(cost, parameters, manifolds);
  std::vector<const double*> blocks;
  for (const std::vector<double>& block : parameters) blocks.push_back(block.data());
  ceres::NumericDiffOptions options;
  // Small enough to stay in the domain of most factors.
  options.ridders_relative_initial_step_size = 1e-3;
  const ceres::GradientChecker checker(&cost, &manifolds, options);
  ceres::GradientChecker::ProbeResults results;
  // The verdict of Probe() is not used: it compares entries by relative error, which entries that
  // are zero cannot pass.
  checker.Probe(blocks.data(), 1.0, &results);
  if (!results.return_value || results.local_numeric_jacobians.size() != blocks.size()) {
    return {std::numeric_limits<double>::infinity(), results.error_log};
  }
  JacobianCheck check;
  for (size_t i = 0; i < blocks.size(); ++i) {
    jacobian_check_internal::Compare(i, results.local_jacobians[i],
                                     results.local_numeric_jacobians[i], &check);
  }
  return check;
}

}  // namespace msc_vo
