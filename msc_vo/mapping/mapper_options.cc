// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper_options.h"

#include <cmath>

namespace msc_vo {

bool MapperOptions::IsValid(std::string* error) const {
  if (readout_time && !(std::abs(*readout_time) < 1.0)) {
    *error = "mapping: readout_time must be between -1 and 1 seconds";
    return false;
  }
  if (!(min_window_interval >= 0.0)) {
    *error = "mapping: min_window_interval must not be negative";
    return false;
  }
  return structure.IsValid(error) && fusion.IsValid(error) && selection.IsValid(error) &&
         noise.IsValid(error) && pairs.IsValid(error) && window.IsValid(error) &&
         culling.IsValid(error);
}

}  // namespace msc_vo
