// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/internal/axes_evidence.h"

namespace msc_vo {

/// Largest angle between an axis and the mean of its evidence, radians. Two walls at 80 degrees fit
/// into the cones of two axes with 5 degrees each; depth sensors bend surfaces by 1 degree.
constexpr double kMaxMisfit = DegreesToRadians(2.0);
/// Largest support of a rival hypothesis relative to the best one, counted over the evidence that
/// they do not share: different axes may have one direction in common, as the walls of a house and
/// its annexe share the vertical.
constexpr double kMaxRival = 0.5;

/// Whether the axes pass every test: majority, misfit, extent in three dimensions, and the a
/// contrario test against chance.
bool PassesGates(const DirectionEvidence& evidence, const ScoredAxes& axes);

/// Whether another hypothesis explains nearly as much of the evidence that it does not share with
/// `best`.
bool HasRival(const DirectionEvidence& evidence, const std::vector<ScoredAxes>& hypotheses,
              const Eigen::Matrix3d& best);

}  // namespace msc_vo
