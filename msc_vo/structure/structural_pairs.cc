// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/structural_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/direction_estimate.h"
#include "msc_vo/structure/internal/partner_selection.h"
#include "msc_vo/structure/internal/relation_mixture.h"

namespace msc_vo {

namespace {

// Largest chi-square of a pair: 99.9 % quantiles with two and one degrees of freedom.
constexpr double kMaxChiSquare2 = 13.816;
constexpr double kMaxChiSquare1 = 10.828;
// Smallest probability of a pair not to be one by chance.
constexpr double kMinPairProbability = 0.8;

// A line whose direction is known well enough.
struct Line {
  int64_t id = 0;
  DirectionEstimate estimate;
  double sigma = 0.0;              // radians
  std::vector<int64_t> observers;  // keyframes, ascending
  bool on_axis = false;
};

std::vector<Line> KnownLines(const StructuralPairOptions& options, const WindowData& window) {
  const std::vector<std::optional<DirectionEstimate>> estimates = EstimateDirections(window);
  std::map<int64_t, Line> known;
  for (size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates[i]) continue;
    const double sigma = estimates[i]->Sigma();
    // Three sigmas of a direction must fit into the range of angles.
    if (sigma > DegreesToRadians(options.max_angle / 3.0)) continue;
    const int64_t id = window.lines[i].id;
    known[id] = {id, *estimates[i], sigma, {}, false};
  }
  for (const WindowData::LineObservation& observation : window.line_observations) {
    const auto line = known.find(observation.line);
    if (line != known.end()) line->second.observers.push_back(observation.keyframe);
  }
  for (const WindowData::AxisAlignment& alignment : window.axis_alignments) {
    const auto line = known.find(alignment.line);
    if (line != known.end()) line->second.on_axis = true;
  }
  std::vector<Line> lines;
  for (auto& [id, line] : known) {
    std::sort(line.observers.begin(), line.observers.end());
    lines.push_back(std::move(line));
  }
  return lines;
}

// Whether a keyframe observes both lines.
bool AreCoobserved(const Line& a, const Line& b) {
  auto i = a.observers.begin(), j = b.observers.begin();
  while (i != a.observers.end() && j != b.observers.end()) {
    if (*i == *j) return true;
    *i < *j ? ++i : ++j;
  }
  return false;
}

DirectionDeviation ParallelDeviation(const DirectionEstimate& a, const DirectionEstimate& b) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = a.direction.unitOrthogonal();
  basis.col(1) = a.direction.cross(basis.col(0));
  return {basis.transpose() * b.direction / a.direction.dot(b.direction),
          basis.transpose() * (a.covariance + b.covariance) * basis};
}

AngleDeviation PerpendicularDeviation(const DirectionEstimate& a, const DirectionEstimate& b) {
  return {a.direction.dot(b.direction), b.direction.dot(a.covariance * b.direction) +
                                            a.direction.dot(b.covariance * a.direction)};
}

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
  const std::vector<Line> lines = KnownLines(options_, window);
  const double max_angle = DegreesToRadians(options_.max_angle);
  const double least_parallel = std::cos(max_angle), most_perpendicular = std::sin(max_angle);
  PairCandidates candidates;
  for (const Line& line : lines) candidates.lines.push_back(line.id);
  for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(lines.size()); ++j) {
      const Line &a = lines[i], &b = lines[j];
      if (a.on_axis && b.on_axis) continue;
      const double cosine = std::abs(a.estimate.direction.dot(b.estimate.direction));
      const bool is_parallel = cosine >= least_parallel;
      const bool is_perpendicular = options_.perpendicular && cosine <= most_perpendicular;
      if (!is_parallel && !is_perpendicular) continue;
      if (!AreCoobserved(a, b)) continue;
      const double sigma = std::hypot(a.sigma, b.sigma);
      if (is_parallel) {
        candidates.parallel.push_back({sigma, i, j, ParallelDeviation(a.estimate, b.estimate)});
      } else {
        candidates.perpendicular.push_back(
            {sigma, i, j, PerpendicularDeviation(a.estimate, b.estimate)});
      }
    }
  }
  SelectMostCertain(lines.size(), &candidates.parallel);
  SelectMostCertain(lines.size(), &candidates.perpendicular);
  return candidates;
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
