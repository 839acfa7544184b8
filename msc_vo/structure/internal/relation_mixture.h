// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Probability of each angle, between two lines or between a line and an axis, that the relation is
/// structural rather than accidental. `densities`: of the measured angles for structural relations;
/// `chance`: for unrelated lines, uniform over the range in which relations are sought. The
/// fraction of structural relations is estimated from all angles by expectation maximisation.
std::vector<double> RelationProbabilities(const std::vector<double>& densities, double chance);

}  // namespace msc_vo
