// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/custom_term.h"

namespace msc_vo {

std::vector<CustomParameter> ParametersOf(const CustomTerm::Block& block,
                                          const WindowState& state) {
  std::vector<CustomParameter> parameters;
  parameters.reserve(block.parameters.size());
  for (const StateBlock& b : block.parameters) {
    parameters.push_back({state.Block(b), state.Size(b), state.ManifoldOf(b), true});
  }
  return parameters;
}

double Cost(const CustomTerm& term, const WindowState& state) {
  double sum = 0.0;
  for (const CustomTerm::Block& block : term.blocks) {
    const CustomFactor& factor = *block.factor;
    sum += CustomFactorCost(*factor.cost, factor.loss.get(), ParametersOf(block, state));
  }
  return sum;
}

}  // namespace msc_vo
