// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/id_map.h"
#include "msc_vo/bundle_adjustment/internal/window_state.h"

namespace msc_vo {

/// Validates the extra blocks, the Manhattan axes and the custom factors of a window, and evaluates
/// each factor at the initial values, which must otherwise be valid. Returns the parameter blocks
/// of each factor. Throws std::invalid_argument that names the factor or block.
std::vector<std::vector<StateBlock>> ResolveCustomFactors(const WindowData& data,
                                                          const IdMap& keyframes,
                                                          const IdMap& points, const IdMap& lines);

}  // namespace msc_vo
