// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Returns the median interval of stamps in any order, in the unit of the stamps; 0 for fewer than
/// two.
double MedianInterval(std::vector<double> stamps);

}  // namespace msc_vo
