// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/sensor_calibration.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace msc_vo {

namespace {

// Largest angle between two images, radians: with a field of view of 60 degrees, little is left in
// common.
constexpr double kMaxAngle = 0.8;
// Fewest points that make a pair worth its time.
constexpr int kMinPoints = 40;
constexpr int kMaxIterations = 12;
// Smallest change that continues the iteration, standard deviations.
constexpr double kMinChange = 0.05;

// Every n-th element, so that at most `limit` remain.
template <typename T>
std::vector<T> Thin(std::vector<T> all, size_t limit) {
  if (all.size() <= limit) return all;
  std::vector<T> thinned;
  for (size_t i = 0; i < limit; ++i) thinned.push_back(std::move(all[i * all.size() / limit]));
  return thinned;
}

// Pairs of images that may show the same points.
std::vector<std::pair<int, int>> CandidatePairs(const CalibrationSequence& views, size_t limit) {
  std::vector<std::pair<int, int>> candidates;
  for (int b = 1; b < static_cast<int>(views.size()); ++b) {
    for (int a = 0; a < b; ++a) {
      const double angle =
          views[a].cam_from_world.rotation().angularDistance(views[b].cam_from_world.rotation());
      if (angle <= kMaxAngle) candidates.emplace_back(a, b);
    }
  }
  return Thin(std::move(candidates), limit);
}

struct Pairs {
  std::vector<CalibrationPair> pairs;
  int num_views = 0;
};

void MatchViews(const CorrectedCamera& camera, const CalibrationSequence& views,
                const CalibrationEffort& effort, Pairs* result) {
  std::vector<std::pair<std::pair<int, int>, CalibrationPair>> matched;
  for (const auto& [a, b] : CandidatePairs(views, effort.max_candidates)) {
    const CalibrationPair pair(camera, &views[a], &views[b]);
    if (pair.num_points() >= kMinPoints) matched.push_back({{a, b}, pair});
  }
  std::set<int> used;
  for (auto& [indices, pair] : Thin(matched, effort.max_pairs)) {
    used.insert(indices.first);
    used.insert(indices.second);
    result->pairs.push_back(std::move(pair));
  }
  result->num_views += static_cast<int>(used.size());
}

CalibrationInformation SumOf(const Pairs& pairs, const SensorCorrection::Vector& correction) {
  CalibrationInformation sum;
  int num_pairs = 0;
  for (const CalibrationPair& pair : pairs.pairs) {
    const auto information = pair.Linearize(correction);
    if (!information) continue;
    sum += *information;
    ++num_pairs;
  }
  if (num_pairs == 0) return sum;
  const double scale = std::min(1.0, (pairs.num_views - 1.0) / num_pairs);
  sum.matrix *= scale;
  sum.vector *= scale;
  return sum;
}

std::vector<PairResidual> ResidualsOf(const Pairs& pairs,
                                      const SensorCorrection::Vector& correction) {
  std::vector<PairResidual> all;
  for (const CalibrationPair& pair : pairs.pairs) {
    const std::vector<PairResidual> residuals = pair.Residuals(correction);
    all.insert(all.end(), residuals.begin(), residuals.end());
  }
  return all;
}

// Groups that the pairs find wrong are; maps take part in the decision on those that the pairs may
// find wrong.
CorrectionEstimate Select(const CalibrationInformation& of_pairs,
                          const CalibrationInformation& of_maps, const WrongGroups& known_wrong,
                          const WrongGroups& known_right) {
  const CorrectionEstimate by_pairs = SelectCorrections(of_pairs, known_wrong, known_right);
  WrongGroups right = known_right;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    right[g] =
        right[g] || (!by_pairs.is_corrected[g] && by_pairs.log_odds[g] < std::log(kCandidateOdds));
  }
  CalibrationInformation sum = of_pairs;
  sum += of_maps;
  return SelectCorrections(sum, by_pairs.is_corrected, right);
}

// Gauss-Newton for the model in which exactly the groups `wrong` are corrected. The errors of maps
// count as independent, so that the standard deviations are those of the pairs alone.
CorrectionEstimate Iterate(const Pairs& pairs, const CalibrationInformation& of_maps,
                           const WrongGroups& wrong, SensorCorrection::Vector at) {
  CorrectionEstimate estimate;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    CalibrationInformation sum = SumOf(pairs, at);
    const SensorCorrection::Vector sigma = EstimateCorrections(sum, wrong).sigma;
    sum += of_maps;
    estimate = EstimateCorrections(sum, wrong);
    estimate.sigma = sigma;
    const SensorCorrection::Vector change =
        (estimate.correction - at).cwiseQuotient(estimate.sigma);
    at = estimate.correction;
    if (change.cwiseAbs().maxCoeff() < kMinChange) break;
  }
  return estimate;
}

}  // namespace

SensorCalibrationResult CalibrateSensor(const PinholeCamera& camera,
                                        const LensDistortion& distortion,
                                        const std::vector<CalibrationSequence>& sequences,
                                        const WrongGroups& known_wrong,
                                        const WrongGroups& known_right,
                                        const CalibrationInformation& of_maps,
                                        const CalibrationEffort& effort) {
  Pairs pairs;
  for (const CalibrationSequence& views : sequences) {
    MatchViews(CorrectedCamera(camera, distortion), views, effort, &pairs);
  }
  SensorCalibrationResult result;
  result.num_views = pairs.num_views;
  result.num_pairs = static_cast<int>(pairs.pairs.size());
  // The models are compared by a quadratic approximation at the optimum of the one without
  // restrictions, which is near to the optimum of each model that can win.
  WrongGroups unrestricted;
  for (int g = 0; g < kNumCorrectionGroups; ++g) unrestricted[g] = !known_right[g];
  const CorrectionEstimate free =
      Iterate(pairs, {}, unrestricted, SensorCorrection::Vector::Zero());
  const CorrectionEstimate selected =
      Select(SumOf(pairs, free.correction), of_maps, known_wrong, known_right);
  const bool is_new = selected.is_corrected != known_wrong;
  result.estimate = Iterate(pairs, is_new ? CalibrationInformation() : of_maps,
                            selected.is_corrected, selected.correction);
  result.estimate.log_odds = selected.log_odds;
  result.given_residuals = ResidualsOf(pairs, SensorCorrection::Vector::Zero());
  result.estimated_residuals = ResidualsOf(pairs, result.estimate.correction);
  return result;
}

}  // namespace msc_vo
