// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/number_range.h"

#include <optional>
#include <string>

#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

CLI::Validator NumberFrom(double min, double max) {
  const std::string range = FormatText("[%.12g - %.12g]", min, max);
  return CLI::Validator(
      [min, max, range](const std::string& text) {
        const std::optional<double> value = ParseNumber(text);
        return value && *value >= min && *value <= max ? std::string()
                                                       : "Value " + text + " not in range " + range;
      },
      "in " + range);
}

}  // namespace msc_vo
