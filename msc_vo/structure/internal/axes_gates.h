// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/structure/internal/axes_score.h"

namespace msc_vo {

/// Whether the axes pass every test of the options: majority, misfit, extent in three dimensions
/// and the a contrario test against chance.
bool PassesGates(const CoarseAxesOptions& options, const DirectionEvidence& evidence,
                 const ScoredAxes& axes);

/// Whether another hypothesis explains nearly as much of the evidence that it does not share with
/// `best`.
bool HasRival(const CoarseAxesOptions& options, const DirectionEvidence& evidence,
              const std::vector<ScoredAxes>& hypotheses, const Eigen::Matrix3d& best);

}  // namespace msc_vo
