// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// Describes how the stamps of a list, as they are written, lost digits that tell its images or
/// poses apart: scientific notation with too few digits ("1.604645e+09"), or single precision.
/// Empty if they are precise to a millisecond.
std::string DescribeLostDigits(const std::vector<std::string>& stamps);

}  // namespace msc_vo
