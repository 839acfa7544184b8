// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <ceres/cost_function.h>

#include "apps/python/shared_object.h"

namespace msc_vo {

/// A cost function that is a Python callable: its arguments are the values of the parameter blocks,
/// its result is (residuals, [Jacobian of block 0, ...]), or None where it is not defined. Takes
/// the GIL. Exceptions of the callable pass through the solver.
class PythonCostFunction : public ceres::CostFunction {
 public:
  PythonCostFunction(SharedObject callable, int num_residuals, const std::vector<int>& block_sizes);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  SharedObject callable_;
};

/// The same for a callable that returns residuals only; Jacobians are central differences.
std::shared_ptr<const ceres::CostFunction> MakeNumericCostFunction(
    SharedObject callable, int num_residuals, const std::vector<int>& block_sizes);

}  // namespace msc_vo
