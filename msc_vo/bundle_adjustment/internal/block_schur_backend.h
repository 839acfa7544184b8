// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

/// Result of a minimisation.
struct MinimizerReport {
  bool usable = false;  ///< False: the state must be discarded.
  int num_iterations = 0;
  int num_accepted = 0;         ///< Steps that decreased the cost enough to be taken.
  std::string schur_structure;  ///< Solver and structure of the normal equations.
  std::string message;          ///< Reason for termination.
};

/// Minimises the cost of `terms` over `state` by Levenberg-Marquardt in at most `max_iterations`
/// steps, with a linear solver specialised for windows (SolveStep). `structure` must be built from
/// `terms`.
///
/// The steps are those of Ceres with default options, up to rounding, as long as no step moves a
/// landmark behind a camera that observes it or leaves a line without length. There, Ceres rejects
/// the whole step; here the landmark keeps its value and the rest of the step is evaluated.
MinimizerReport MinimizeWithBlockSchur(const BlockStructure& structure, const WindowTerms& terms,
                                       int max_iterations, const WindowStageObserver& enter_stage,
                                       WindowState* state);

}  // namespace msc_vo
