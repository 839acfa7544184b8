// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

namespace msc_vo {

// How a minimisation of the window's sum ended.
struct MinimizerReport {
  bool usable = false;  // false: the state is of no use
  int num_iterations = 0;
  std::string schur_structure;  // and what it made of the window
  std::string message;
};

// Minimises the sum of `terms` over `state` by Levenberg-Marquardt, in at most `max_iterations`
// steps: the same steps that Ceres takes with its defaults, to rounding, with linear algebra made
// for the window (SolveStep). But where a step takes a landmark behind a camera that sees it, the
// landmark stays and the others move, while Ceres refuses the step. `structure` is that of the
// terms.
MinimizerReport MinimizeWindow(const WindowStructure& structure, const WindowTerms& terms,
                               int max_iterations, const WindowStageObserver& enter_stage,
                               WindowState* state);

}  // namespace msc_vo
