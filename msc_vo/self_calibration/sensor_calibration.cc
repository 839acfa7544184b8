// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/sensor_calibration.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "msc_vo/self_calibration/pair_view.h"

namespace msc_vo {

namespace {

// Largest angle between two images, as a ratio of the horizontal field of view: little is left in
// common.
constexpr double kMaxAngle = 0.76;
constexpr int kMaxIterations = 12;
// Smallest change that continues the iteration, standard deviations.
constexpr double kMinSigmaChange = 0.05;

// Every n-th element, so that at most `limit` remain.
template <typename T>
std::vector<T> Thin(std::vector<T> all, size_t limit) {
  if (all.size() <= limit) return all;
  std::vector<T> thinned;
  for (size_t i = 0; i < limit; ++i) thinned.push_back(std::move(all[i * all.size() / limit]));
  return thinned;
}

// Radians.
double HorizontalFieldOfView(const PinholeCamera& camera) {
  return 2.0 * std::atan(0.5 * camera.width / std::abs(camera.fx));
}

// Pairs of images that may show the same points: with at most `max_angle` (radians) between them.
std::vector<std::pair<int, int>> CandidatePairs(const CalibrationSequence& views, double max_angle,
                                                size_t limit) {
  std::vector<std::pair<int, int>> candidates;
  for (int b = 1; b < static_cast<int>(views.size()); ++b) {
    for (int a = 0; a < b; ++a) {
      const double angle =
          views[a].cam_from_world.rotation().angularDistance(views[b].cam_from_world.rotation());
      if (angle <= max_angle) candidates.emplace_back(a, b);
    }
  }
  return Thin(std::move(candidates), limit);
}

// Groups that the pairs find wrong are; maps take part in the decision on those that the pairs may
// find wrong.
CorrectionEstimate Select(const CalibrationInformation& of_pairs,
                          const CalibrationInformation& of_maps,
                          const CorrectionGroups& known_wrong,
                          const CorrectionGroups& known_right) {
  const CorrectionEstimate by_pairs = SelectCorrections(of_pairs, known_wrong, known_right);
  CorrectionGroups right = known_right;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    right[g] =
        right[g] || (!by_pairs.is_corrected[g] && by_pairs.log_odds[g] < std::log(kCandidateOdds));
  }
  CalibrationInformation sum = of_pairs;
  sum += of_maps;
  return SelectCorrections(sum, by_pairs.is_corrected, right);
}

}  // namespace

SensorCalibration::SensorCalibration(const PinholeCamera& camera, const LensDistortion& distortion,
                                     const std::vector<CalibrationSequence>& sequences,
                                     const CalibrationEffort& effort) {
  const CorrectedCamera corrected(camera, distortion);
  for (const CalibrationSequence& views : sequences) {
    sequences_.push_back(Match(corrected, views, effort));
  }
}

int SensorCalibration::num_views() const {
  int count = 0;
  for (const Pairs& pairs : sequences_) count += pairs.num_views;
  return count;
}

int SensorCalibration::num_pairs() const {
  int count = 0;
  for (size_t i = 0; i < sequences_.size(); ++i) count += num_pairs(i);
  return count;
}

int SensorCalibration::num_pairs(size_t sequence) const {
  return static_cast<int>(sequences_.at(sequence).pairs.size());
}

SensorCalibration::Pairs SensorCalibration::Match(const CorrectedCamera& camera,
                                                  const CalibrationSequence& views,
                                                  const CalibrationEffort& effort) {
  const double max_angle = kMaxAngle * HorizontalFieldOfView(camera.camera());
  std::vector<std::pair<std::pair<int, int>, CalibrationPair>> matched;
  for (const auto& [a, b] : CandidatePairs(views, max_angle, effort.max_candidates)) {
    const CalibrationPair pair(camera, &views[a], &views[b]);
    if (pair.num_points() >= kMinPairPoints) matched.push_back({{a, b}, pair});
  }
  Pairs result;
  std::set<int> used;
  for (auto& [indices, pair] : Thin(std::move(matched), effort.max_pairs)) {
    used.insert(indices.first);
    used.insert(indices.second);
    result.pairs.push_back(std::move(pair));
  }
  result.num_views = static_cast<int>(used.size());
  return result;
}

CalibrationInformation SensorCalibration::SumOf(const Pairs& pairs,
                                                const SensorCorrection::Vector& correction) {
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

CalibrationInformation SensorCalibration::Sum(const SensorCorrection::Vector& correction) const {
  CalibrationInformation sum;
  for (const Pairs& pairs : sequences_) sum += SumOf(pairs, correction);
  return sum;
}

CorrectionEstimate SensorCalibration::Iterate(const CalibrationInformation& of_maps,
                                              const CorrectionGroups& wrong,
                                              SensorCorrection::Vector at) const {
  CorrectionEstimate estimate;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    CalibrationInformation sum = Sum(at);
    const SensorCorrection::Vector sigma = EstimateCorrections(sum, wrong).sigma;
    sum += of_maps;
    estimate = EstimateCorrections(sum, wrong);
    estimate.sigma = sigma;
    const SensorCorrection::Vector change =
        (estimate.correction - at).cwiseQuotient(estimate.sigma);
    at = estimate.correction;
    if (change.cwiseAbs().maxCoeff() < kMinSigmaChange) break;
  }
  return estimate;
}

SensorCalibration::Estimate SensorCalibration::MakeEstimate(
    const CorrectionGroups& known_wrong, const CorrectionGroups& known_right,
    const CalibrationInformation& of_maps) const {
  // The models are compared by a quadratic approximation at the optimum of the one without
  // restrictions, which is near to the optimum of each model that can win.
  CorrectionGroups all, unrestricted;
  all.fill(true);
  for (int g = 0; g < kNumCorrectionGroups; ++g) unrestricted[g] = !known_right[g];
  const CorrectionEstimate free = Iterate({}, unrestricted, SensorCorrection::Vector::Zero());
  const CalibrationInformation of_pairs = Sum(free.correction);
  const CorrectionEstimate selected = Select(of_pairs, of_maps, known_wrong, known_right);
  const bool is_new = selected.is_corrected != known_wrong;
  Estimate estimate;
  estimate.selected = Iterate(is_new ? CalibrationInformation() : of_maps, selected.is_corrected,
                              selected.correction);
  estimate.selected.log_odds = selected.log_odds;
  estimate.unrestricted = EstimateCorrections(of_pairs, all).correction;
  return estimate;
}

std::vector<PairResidual> SensorCalibration::Residuals(
    const SensorCorrection::Vector& correction) const {
  std::vector<PairResidual> all;
  for (const Pairs& pairs : sequences_) {
    for (const CalibrationPair& pair : pairs.pairs) {
      const std::vector<PairResidual> residuals = pair.Residuals(correction);
      all.insert(all.end(), residuals.begin(), residuals.end());
    }
  }
  return all;
}

}  // namespace msc_vo
