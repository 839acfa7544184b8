// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

// Makes the folder that `msc_vo synthesize` renders with these arguments. Tests share what one of
// them has rendered, also in other processes. Throws std::runtime_error if it cannot be rendered.
void RenderSequence(const std::string& folder, const std::vector<std::string>& arguments);

}  // namespace msc_vo
