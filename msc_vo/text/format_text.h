// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdio>
#include <string>

#include "msc_vo/text/classic_locale.h"

namespace msc_vo {

/// Formats like printf, but in the "C" locale, and returns the result as a string. `Values` are
/// types that printf accepts.
template <typename... Values>
std::string FormatText(const char* format, Values... values) {
  const ClassicLocale locale;
  std::string text(static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

}  // namespace msc_vo
