// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// `text` with the five characters that mean something in HTML and in quoted attributes replaced.
std::string EscapeHtml(const std::string& text);

/// `value` with that many decimals and a point, whatever the locale says; no minus before zero.
/// "-" if it is not finite.
std::string FormatFixed(double value, int decimals);

}  // namespace msc_vo
