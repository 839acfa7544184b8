// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/readout_time_estimator.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/self_calibration/readout_time_pair.h"

namespace msc_vo {

namespace {

// Covisible keyframes that each new keyframe is paired with. More add little, because the pairs
// share the error of the new keyframe.
constexpr size_t kMaxPartners = 2;
// Time constant of the exponential average, keyframes. Old estimates decay, because the first ones
// come from poses that were estimated without compensation and are biased towards 0.
constexpr double kMemory = 25.0;
// Upper bound, seconds: the interval of images at 30 Hz, because the rows of two images are not
// read at the same time. At higher rates it is the mean interval and a fifth for the jitter of the
// stamps. Lower rates do not raise it: images may have been left out.
constexpr double kMaxReadoutTime = 1.0 / 30.0;
constexpr double kMaxIntervals = 1.2;
// Longest interval that counts towards the mean, seconds: a longer one is a gap in the recording.
constexpr double kLongestInterval = 0.2;
// Prior of a rolling shutter, seconds: depth cameras and phones take 10 to 33 ms.
constexpr double kTypicalReadoutTime = 0.020;
constexpr double kReadoutTimeSigma = 0.008;
// Prior probability of a camera mounted upside down, whose rows are read from the bottom.
constexpr double kUpsideDown = 0.001;
// Odds of a rolling to a global shutter above which compensation starts; it ends below 1.
// Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kRollingOdds = 10.0;
// Lower bound of the standard deviation (seconds) of the estimate from poses without compensation.
constexpr double kFirstSigma = 0.01;

double Square(double x) { return x * x; }

// Logarithm of the density of a zero-mean normal distribution, up to a constant.
double LogDensity(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(variance));
}

// Logarithm of the likelihood ratio of a rolling to a global shutter, for an estimate (seconds)
// with its variance (seconds^2).
double RollingLogOdds(double estimate, double variance) {
  const double spread = variance + Square(kReadoutTimeSigma);
  const double upright = LogDensity(estimate - kTypicalReadoutTime, spread);
  const double upside_down =
      std::log(kUpsideDown) + LogDensity(estimate + kTypicalReadoutTime, spread);
  return std::max(upright, upside_down) - LogDensity(estimate, variance);
}

}  // namespace

void ReadoutTimeEstimator::Update(const Map& map, KeyframeId newest,
                                  const std::optional<double>& frame_interval) {
  std::vector<const Keyframe*> partners;
  for (const Map::Covisible& other : map.FindCovisible(newest)) {
    if (partners.size() == kMaxPartners) break;
    if (map.IsOfEarlierSession(other.keyframe)) continue;
    partners.push_back(map.FindKeyframe(other.keyframe));
  }
  Update(*map.FindKeyframe(newest), partners, frame_interval);
}

void ReadoutTimeEstimator::Update(const Keyframe& newest,
                                  const std::vector<const Keyframe*>& partners,
                                  const std::optional<double>& frame_interval) {
  if (!estimates_) return;
  if (frame_interval) {
    frame_interval_ += (std::min(*frame_interval, kLongestInterval) - frame_interval_) / kMemory;
  }
  double sum = 0.0, weighted_sum = 0.0, largest = 0.0;
  for (const Keyframe* partner : partners) {
    const auto estimate = EstimateReadoutTime(*partner, newest, readout_time_);
    if (!estimate) continue;
    sum += estimate->information;
    weighted_sum += estimate->information * std::clamp(estimate->readout_time, -Bound(), Bound());
    largest = std::max(largest, estimate->information);
  }
  if (sum <= 0.0) return;
  // The pairs share the error of the newest keyframe: together they have the information of the
  // best one.
  AddEstimate(weighted_sum / sum, largest);
  UpdateDecision();
}

double ReadoutTimeEstimator::sigma() const {
  if (!estimates_) return 0.0;
  // That of a rolling shutter.
  const double prior = 1.0 / Square(kReadoutTimeSigma);
  const double mean = (weighted_sum_ + prior * std::copysign(kTypicalReadoutTime, weighted_sum_)) /
                      (information_ + prior);
  const double variance = 1.0 / (information_ + prior);
  if (readout_time_ != 0.0) return std::sqrt(variance);
  const double log_odds =
      information_ > 0.0 ? RollingLogOdds(weighted_sum_ / information_, 1.0 / information_) : 0.0;
  return std::sqrt((Square(mean) + variance) / (1.0 + std::exp(-log_odds)));
}

double ReadoutTimeEstimator::Bound() const {
  return std::min(kMaxReadoutTime, kMaxIntervals * frame_interval_);
}

void ReadoutTimeEstimator::AddEstimate(double estimate, double information) {
  information_ += information - information_ / kMemory;
  weighted_sum_ += information * estimate - weighted_sum_ / kMemory;
}

void ReadoutTimeEstimator::UpdateDecision() {
  double estimate = weighted_sum_ / information_;
  const double log_odds = RollingLogOdds(estimate, 1.0 / information_);
  if (readout_time_ == 0.0) {
    if (log_odds < std::log(kRollingOdds)) return;
    information_ = std::min(information_, 1.0 / Square(kFirstSigma));
    weighted_sum_ = information_ * estimate;
  }
  const double prior = 1.0 / Square(kReadoutTimeSigma);
  estimate = (weighted_sum_ + prior * std::copysign(kTypicalReadoutTime, estimate)) /
             (information_ + prior);
  readout_time_ = log_odds < 0.0 ? 0.0 : std::clamp(estimate, -Bound(), Bound());
}

}  // namespace msc_vo
