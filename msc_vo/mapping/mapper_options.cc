// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper_options.h"

namespace msc_vo {

bool MapperOptions::IsValid(std::string* error) const {
  return structure.IsValid(error) && fusion.IsValid(error) && selection.IsValid(error) &&
         noise.IsValid(error) && axes.IsValid(error) && pairs.IsValid(error) &&
         window.IsValid(error) && culling.IsValid(error);
}

}  // namespace msc_vo
