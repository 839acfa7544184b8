// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"
#include "msc_vo/bundle_adjustment/internal/window_step.h"

namespace msc_vo {

/// Result of a minimisation.
struct MinimizerReport {
  bool usable = false;  ///< False: the state must be discarded.
  int num_iterations = 0;
  int num_accepted = 0;         ///< Steps that decreased the cost enough to be taken.
  std::string schur_structure;  ///< Solver and structure of the normal equations.
  std::string message;          ///< Reason for termination.
};

/// Radius of the trust region, the inverse of the damping relative to the diagonal of the Hessian.
/// Rules and constants are those of Ceres.
class TrustRegion {
 public:
  double radius() const { return radius_; }
  bool IsEmpty() const { return radius_ < 1e-32; }

  /// `gain`: ratio of actual to predicted decrease of the cost.
  void Accept(double gain);
  void Reject();

 private:
  double radius_ = 1e4;
  double shrinkage_ = 2.0;
};

/// Minimises the cost of `terms` over `state` by Levenberg-Marquardt in at most `max_iterations`
/// steps, with a linear solver specialised for windows (SolveStep). `structure` must be built from
/// `terms`.
///
/// The steps are those of Ceres with default options, up to rounding, as long as no step moves a
/// landmark behind a camera that observes it or leaves a line without length. There, Ceres rejects
/// the whole step; here the landmark keeps its value and the rest of the step is evaluated.
class BlockSchurMinimizer {
 public:
  /// `terms` and `state` must outlive the minimiser.
  BlockSchurMinimizer(BlockStructure structure, const WindowTerms& terms, int max_iterations,
                      WindowStageObserver enter_stage, WindowState* state);

  /// Evaluates the initial state at the first call; then alternately computes a step and evaluates
  /// the state after it. Returns whether to go on.
  bool Advance();
  const MinimizerReport& report() const { return report_; }

 private:
  void Enter(WindowStage stage) const;
  void EvaluateInitialState();
  void ComputeStep();
  // Takes or rejects the step. Returns false at convergence.
  bool EvaluateStep();

  const BlockStructure structure_;
  const WindowTerms& terms_;
  const int max_iterations_;
  const WindowStageObserver enter_stage_;
  WindowState* state_;
  MinimizerReport report_;
  WindowEquations equations_, next_;  // at the state, and after a step
  TrustRegion region_;
  WindowStep step_;
  bool has_step_ = false;  // that has not been evaluated
};

}  // namespace msc_vo
