// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// Escapes & < > " ' for HTML text and quoted attributes.
std::string EscapeHtml(const std::string& text);

/// The beginning of a page with the style of the report, from the doctype to its heading, which is
/// the title.
std::string PageHead(const std::string& title);

/// The value with the given number of decimals and a decimal point, independent of the locale;
/// negative zero has no sign. "-" if the value is not finite.
std::string FormatFixed(double value, int decimals);

}  // namespace msc_vo
