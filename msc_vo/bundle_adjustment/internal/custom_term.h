// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>

#include "msc_vo/bundle_adjustment/internal/window_state.h"

namespace msc_vo {

/// The residual blocks of custom factors, in the order of the data.
struct CustomTerm {
  struct Block {
    const CustomFactor* factor = nullptr;
    std::vector<StateBlock> parameters;  ///< In the order of the cost function.
  };
  std::vector<Block> blocks;
};

/// Half the sum of robust squared norms; NaN where a factor is undefined.
double Cost(const CustomTerm& term, const WindowState& state);

/// Residual and derivatives of a custom factor, multiplied by the square root of the weight that
/// its loss gives to the residual.
struct CustomLinearization {
  double cost = 0.0;  ///< Half the robust squared norm.
  Eigen::VectorXd residual;
  /// Derivatives in the tangent space of each parameter block; empty for constant blocks.
  std::vector<Eigen::MatrixXd> jacobians;
};

/// Evaluates a factor. `variable`: for each parameter block, whether its derivative is needed.
/// Returns false if the factor is undefined or not finite at `state`.
bool Linearize(const CustomTerm::Block& block, const WindowState& state,
               const std::vector<bool>& variable, CustomLinearization* linearization);

/// Describes why Linearize() fails; empty if it succeeds.
std::string EvaluationError(const CustomTerm::Block& block, const WindowState& state,
                            const std::vector<bool>& variable);

}  // namespace msc_vo
