// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/readout_time_estimator.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/self_calibration/readout_time_pair.h"

namespace msc_vo {

namespace {

// Keyframes that each new one is compared with: those that see most of the same. More would add
// little, as all of them count as one.
constexpr size_t kMaxPartners = 2;
// Of so many keyframes the estimate remembers: the first ones are of poses that suffered from the
// shutter, and say too little.
constexpr double kMemory = 25.0;
// Seconds. Rows of an image are read while those of the next are not: the cameras run at 30 Hz,
// whatever was kept of their images.
constexpr double kMaxReadout = 1.0 / 30.0;
// Seconds: rolling shutters of depth cameras and phones take 10 to 33 ms.
constexpr double kTypicalReadout = 0.020;
constexpr double kReadoutSpread = 0.008;
// Rows are read from the top, unless the camera hangs upside down: one in a thousand.
constexpr double kUpsideDown = 0.001;
// A shutter rolls if that is so many times as likely as that it is global, and is global again if
// that is the likelier. The odds of 35 sequences with a global one come to 7 at most (a corridor;
// the second one 3), those of eight with a rolling one to 20 and more.
constexpr double kCertain = 10.0;
// Seconds, sigma of what was estimated with poses that did not know of the shutter.
constexpr double kFirstSigma = 0.01;

double Square(double x) { return x * x; }

// Logarithm of the density of a normal deviate with that variance, but for a constant.
double LogDensity(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(variance));
}

// Logarithm of how many times as likely an estimate with that variance (seconds^2) is with a
// rolling shutter as with a global one.
double RollingLogOdds(double estimate, double variance) {
  const double spread = variance + Square(kReadoutSpread);
  const double upright = LogDensity(estimate - kTypicalReadout, spread);
  const double upside_down = std::log(kUpsideDown) + LogDensity(estimate + kTypicalReadout, spread);
  return std::max(upright, upside_down) - LogDensity(estimate, variance);
}

}  // namespace

void ReadoutTimeEstimator::Update(const Map& map, KeyframeId newest) {
  if (!learns_) return;
  const Keyframe& to = *map.FindKeyframe(newest);
  auto partners = map.FindCovisible(newest);
  partners.resize(std::min(partners.size(), kMaxPartners));
  double sum = 0.0, weighted_sum = 0.0, largest = 0.0;
  for (const Map::Covisible& other : partners) {
    const auto estimate = EstimateReadoutTime(*map.FindKeyframe(other.keyframe), to, readout_time_);
    if (!estimate) continue;
    sum += estimate->information;
    weighted_sum +=
        estimate->information * std::clamp(estimate->readout_time, -kMaxReadout, kMaxReadout);
    largest = std::max(largest, estimate->information);
  }
  if (sum <= 0.0) return;
  // All share what is wrong with the newest one: together they are as good as the best of them.
  Remember(weighted_sum / sum, largest);
  Decide();
}

void ReadoutTimeEstimator::Remember(double estimate, double information) {
  information_ += information - information_ / kMemory;
  weighted_sum_ += information * estimate - weighted_sum_ / kMemory;
}

void ReadoutTimeEstimator::Decide() {
  double estimate = weighted_sum_ / information_;
  const double log_odds = RollingLogOdds(estimate, 1.0 / information_);
  if (readout_time_ == 0.0) {
    if (log_odds < std::log(kCertain)) return;
    information_ = std::min(information_, 1.0 / Square(kFirstSigma));
    weighted_sum_ = information_ * estimate;
  }
  const double prior = 1.0 / Square(kReadoutSpread);
  estimate =
      (weighted_sum_ + prior * std::copysign(kTypicalReadout, estimate)) / (information_ + prior);
  readout_time_ = log_odds < 0.0 ? 0.0 : std::clamp(estimate, -kMaxReadout, kMaxReadout);
}

}  // namespace msc_vo
