// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"

namespace msc_vo {

/// Whether the linked Ceres supports a solver.
bool IsAvailable(BundleAdjustmentSolver solver);

/// Minimises the cost of `terms` over `state` with Ceres, as the WindowProblem of these.
MinimizerReport MinimizeWithCeres(const BundleAdjustmentOptions& options, const WindowData& data,
                                  const WindowTerms& terms, int max_iterations, WindowState* state);

}  // namespace msc_vo
