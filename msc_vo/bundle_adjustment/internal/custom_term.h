// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/custom_linearization.h"
#include "msc_vo/bundle_adjustment/internal/window_state.h"

namespace msc_vo {

/// The residual blocks of custom factors, in the order of the data.
struct CustomTerm {
  struct Block {
    const CustomFactor* factor = nullptr;
    std::vector<StateBlock> parameters;  ///< In the order of the cost function.
  };
  std::vector<Block> blocks;
};

/// The parameter blocks of a factor at `state`, all of them variable. They point into `state`.
std::vector<CustomParameter> ParametersOf(const CustomTerm::Block& block, const WindowState& state);

/// Half the sum of robust squared norms; NaN where a factor is undefined.
double Cost(const CustomTerm& term, const WindowState& state);

}  // namespace msc_vo
