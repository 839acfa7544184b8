// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

/// Describes how the stamps of a list, as they are written, lost digits that tell its images or
/// poses apart: scientific notation with too few digits ("1.604645e+09"), or single precision.
/// Empty if they are precise to a millisecond.
std::string DescribeLostDigits(const std::vector<std::string>& stamps);

/// Adds the leading zeros of fractions of a second that are whole numbers of milliseconds,
/// microseconds or nanoseconds: {"5", "66"} -> {"005", "066"}. Returns fractions of more than nine
/// digits as they are.
std::vector<std::string> PadFractions(std::vector<std::string> fractions);

/// Corrects the stamps in a field of the lines if they were written as seconds, a point and a whole
/// number of nanoseconds without leading zeros: if they ascend with these zeros only. Returns
/// whether it did.
bool RestoreFractions(size_t field, std::vector<TextLine>* lines);

}  // namespace msc_vo
