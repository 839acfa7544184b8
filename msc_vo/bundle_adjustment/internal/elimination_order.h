// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_validation.h"

namespace msc_vo {

// Eliminating a line binds all that share a factor with it, so that of two paired lines one at
// least must stay in the reduced system, whose cost grows with its cube. Lines with few partners
// are eliminated first (ties by position), each keeping its partners: where pairs lead to a few
// well-known lines, only those are left. Returns, for each of `num_lines`, whether it stays.
std::vector<bool> LinesInReducedSystem(int num_lines, const std::vector<WindowIndex::Pair>& pairs);

}  // namespace msc_vo
