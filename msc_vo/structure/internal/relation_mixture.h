// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Probability of each angle, between two lines or between a line and an axis, to have been built
/// as what it is near to, rather than by chance. `densities`: of the measured angles if they were
/// built so; `chance`: the same for unrelated lines, uniform over the range in which relations are
/// sought. The fraction of related ones is estimated from all of them by expectation maximisation.
std::vector<double> RelationProbabilities(const std::vector<double>& densities, double chance);

}  // namespace msc_vo
