// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/structural_pairs.h"

#include <cmath>
#include <utility>
#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/internal/relation_mixture.h"

namespace msc_vo {

namespace {

// Largest chi-square of a pair: 99.9 % quantiles with two and one degrees of freedom.
constexpr double kMaxChiSquare2 = 13.816;
constexpr double kMaxChiSquare1 = 10.828;
// Smallest probability of a pair not to be one by chance.
constexpr double kMinPairProbability = 0.8;

// Removes pairs that may well be near to the angle by chance.
template <typename Deviation>
void RemoveUnlikely(const DeviationEstimator& deviation, double chance, double max_chi_square,
                    std::vector<PairCandidates::Pair<Deviation>>* candidates) {
  std::vector<double> densities;
  for (const auto& candidate : *candidates) {
    densities.push_back(deviation.Density(candidate.deviation));
  }
  const std::vector<double> probabilities = RelationProbabilities(densities, chance);
  std::vector<PairCandidates::Pair<Deviation>> likely;
  for (size_t i = 0; i < candidates->size(); ++i) {
    PairCandidates::Pair<Deviation> candidate = (*candidates)[i];
    candidate.probability = probabilities[i];
    if (candidate.probability < kMinPairProbability) continue;
    if (deviation.ChiSquare(candidate.deviation) > max_chi_square) continue;
    likely.push_back(candidate);
  }
  *candidates = std::move(likely);
}

// Partners of each line. A perpendicular pair constrains one of the two components of a direction.
std::vector<double> CountPartners(const PairCandidates& candidates, size_t num_lines) {
  std::vector<double> partners(num_lines, 0.0);
  for (const auto& pair : candidates.parallel) {
    partners[pair.i] += pair.probability;
    partners[pair.j] += pair.probability;
  }
  for (const auto& pair : candidates.perpendicular) {
    partners[pair.i] += 0.5 * pair.probability;
    partners[pair.j] += 0.5 * pair.probability;
  }
  return partners;
}

template <typename Deviation>
std::vector<WindowData::LinePair> MakePairs(
    const std::vector<int64_t>& lines, const std::vector<double>& partners,
    const DeviationEstimator& deviation,
    const std::vector<PairCandidates::Pair<Deviation>>& candidates) {
  std::vector<WindowData::LinePair> pairs;
  for (const PairCandidates::Pair<Deviation>& c : candidates) {
    const double shared = (partners[c.i] + partners[c.j] + 2.0) / 4.0;
    const double sigma = deviation.Sigma(c.deviation) * std::sqrt(shared / c.probability);
    pairs.push_back({lines[c.i], lines[c.j], sigma, 1, false});
  }
  return pairs;
}

}  // namespace

StructuralPairs::StructuralPairs(const StructuralPairOptions& options) : options_(options) {}

PairCandidates StructuralPairs::Find(const WindowData& window) const {
  if (!options_.parallel && !options_.perpendicular) return {};
  return FindPairCandidates(options_, window);
}

void StructuralPairs::Learn(const PairCandidates& candidates) {
  std::vector<DirectionDeviation> deviations;
  for (const auto& pair : candidates.parallel) deviations.push_back(pair.deviation);
  deviation_.Update(deviations);
}

void StructuralPairs::Add(PairCandidates candidates, WindowData* window) const {
  if (!options_.parallel) candidates.parallel.clear();
  const double range = DegreesToRadians(options_.max_angle);
  RemoveUnlikely(deviation_, 1.0 / (kPi * range * range), kMaxChiSquare2, &candidates.parallel);
  RemoveUnlikely(deviation_, 1.0 / (2.0 * range), kMaxChiSquare1, &candidates.perpendicular);
  const std::vector<int64_t>& lines = candidates.lines;
  const std::vector<double> partners = CountPartners(candidates, lines.size());
  window->parallel_pairs = MakePairs(lines, partners, deviation_, candidates.parallel);
  window->perpendicular_pairs = MakePairs(lines, partners, deviation_, candidates.perpendicular);
}

}  // namespace msc_vo
