// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

// The step that solves the damped normal equations (H + D / radius) step = -gradient, D = diag H.
struct WindowStep {
  Eigen::VectorXd reduced;  // six numbers per unknown pose, then two per kept line's direction
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Matrix<double, 6, 1>> lines;
  double model_decrease = 0.0;  // of the cost, if it were the quadratic that H says
};

// Solves them by the Schur complement. Points and lines are eliminated, but of two paired lines one
// must be kept. As a pair binds them by their directions alone, that means two of a line's six
// numbers: the other four are eliminated, and its direction stays with the poses in the reduced
// system. False if the system is not positive definite.
bool SolveStep(const WindowStructure& structure, const WindowEquations& equations, double radius,
               WindowStep* step);

// Numbers of unknowns of which something is asked.
struct ChosenUnknowns {
  std::vector<int> poses, points, lines;
};

// Blocks of (H + D / radius)^-1 on its diagonal, in the order of the choice.
struct InverseBlocks {
  std::vector<Eigen::Matrix<double, 6, 6>> poses;
  std::vector<Eigen::Matrix3d> points;
  std::vector<Eigen::Matrix<double, 6, 6>> lines;
};

// By the same Schur complement. False if the system is not positive definite.
bool InvertBlocks(const WindowStructure& structure, const WindowEquations& equations, double radius,
                  const ChosenUnknowns& chosen, InverseBlocks* inverse);

// The state after a step.
WindowState Moved(const WindowStructure& structure, const WindowState& state,
                  const WindowStep& step);

}  // namespace msc_vo
