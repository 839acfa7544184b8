// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

/// Solution of the damped normal equations (H + D / radius) step = -gradient, D = diag H.
struct WindowStep {
  /// Solution of the reduced system: six numbers per unknown pose (tangent space of
  /// Rigid3Manifold), then two per line direction, then those of custom factors.
  Eigen::VectorXd reduced;
  std::vector<Eigen::Vector3d> points;             ///< Metres.
  std::vector<Eigen::Matrix<double, 6, 1>> lines;  ///< Start, end; metres.
  std::vector<Eigen::VectorXd> extra;              ///< In the tangent spaces of the extra blocks.
  double model_decrease = 0.0;                     ///< Decrease of the quadratic model of the cost.
};

/// Computes the step by Schur complement and back substitution. Returns false if the equations are
/// not positive definite.
bool SolveStep(const BlockStructure& structure, const WindowEquations& equations, double radius,
               WindowStep* step);

/// Applies a step to the unknowns of `state`.
WindowState Plus(const BlockStructure& structure, const WindowState& state, const WindowStep& step);

/// Adds a step and resets the landmarks at which it made a factor undefined: those behind a camera
/// that observes them, and lines shorter than kMinLineLength. Such a landmark is poorly determined,
/// which should not reject the rest of the step.
WindowState TakeStep(const BlockStructure& structure, const WindowState& state,
                     const WindowStep& step);

}  // namespace msc_vo
