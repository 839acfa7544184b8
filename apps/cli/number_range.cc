// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/number_range.h"

#include <string>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

CLI::Validator NumberFrom(double min, double max) {
  const std::string range = FormatText("[%.12g - %.12g]", min, max);
  return CLI::Validator(
      [min, max, range](std::string& text) {
        double value = 0.0;
        const bool is_number = CLI::detail::lexical_cast(text, value);
        return is_number && value >= min && value <= max
                   ? std::string()
                   : "Value " + text + " not in range " + range;
      },
      "in " + range);
}

}  // namespace msc_vo
