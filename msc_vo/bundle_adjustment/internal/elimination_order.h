// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_validation.h"

namespace msc_vo {

/// Chooses the lines that are not eliminated by the Schur complement. Returns a flag for each of
/// `num_lines` lines: true if the line stays in the reduced system.
///
/// Eliminating a line couples all parameter blocks that share a factor with it, so of two paired
/// lines at least one must stay; the cost of the reduced system grows with the cube of its size.
/// Lines are eliminated greedily in ascending order of their number of pairs (ties in the order of
/// the data), each keeping its partners. Pairs with a few well-observed lines, as the mapper
/// selects them, thus leave only those lines in the reduced system.
std::vector<bool> LinesInReducedSystem(int num_lines, const std::vector<WindowIndex::Pair>& pairs);

}  // namespace msc_vo
