// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/relation_mixture.h"

namespace msc_vo {

std::vector<double> RelationProbabilities(const std::vector<double>& densities, double chance) {
  const auto probability = [&](double ratio, double density) {
    return ratio * density / (ratio * density + (1.0 - ratio) * chance);
  };
  // Two pairs, one of which is related, are the prior: few pairs do not tell the fraction.
  constexpr double kPriorRelated = 1.0, kPriorPairs = 2.0;
  constexpr int kNumIterations = 20;  // the fraction then changes by less than a percent
  double ratio = kPriorRelated / kPriorPairs;
  for (int i = 0; i < kNumIterations; ++i) {
    double num_related = kPriorRelated;
    for (const double density : densities) num_related += probability(ratio, density);
    ratio = num_related / (kPriorPairs + static_cast<double>(densities.size()));
  }
  std::vector<double> probabilities;
  for (const double density : densities) probabilities.push_back(probability(ratio, density));
  return probabilities;
}

}  // namespace msc_vo
