// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace msc_vo {

/// Natural order of file names: runs of digits are compared as numbers, so "2.png" precedes
/// "10.png".
bool NaturalLess(const std::string& a, const std::string& b);

/// Returns the last run of digits in the stem of a path ("frame-000012.color" -> 12).
std::optional<int64_t> FrameNumber(const std::string& path);

/// Returns the time stamp that the name of an image encodes, seconds: "1.033333.png" is a time;
/// other numbers are a date of this century in any TimeUnit, nanoseconds if they have 16 digits or
/// more, and otherwise frame numbers at kDefaultFrameRate. None if the name contains no number.
std::optional<double> StampFromName(const std::string& path);

}  // namespace msc_vo
