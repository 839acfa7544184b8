// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/readout_estimator.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/mapping/readout_pair.h"

namespace msc_vo {

namespace {

// Keyframes that each new one is compared with. The sooner the time is known the better: five
// rendered sequences have 2.9, 3.3 and 4.0 mm in the mean with 4, 3 and 2 of them.
constexpr int kMaxPartners = 4;
// Of so many pairs the estimate remembers, 25 keyframes: the first ones are of poses that suffered
// from the shutter, and say too little.
constexpr double kMemory = 100.0;
// Seconds. Rows of an image are read while those of the next are not: the cameras run at 30 Hz,
// whatever was kept of their images.
constexpr double kMaxReadout = 1.0 / 30.0;
// A shutter rolls if the estimate is at least so large: less moves no row by more than 1.6 px at 70
// degrees per second ...
constexpr double kMinReadout = 0.005;
// ... and has so many sigmas: 30 sequences with a global shutter have 3.7 at most (a corridor; the
// second one 3.2), and six of seven with a rolling one reach four. It is global again below half of
// that size.
constexpr double kCertain = 4.0;
// Seconds, sigma of what was estimated with poses that did not know of the shutter.
constexpr double kFirstSigma = 0.01;

double Square(double x) { return x * x; }

}  // namespace

void ReadoutEstimator::Update(const Map& map, KeyframeId newest) {
  if (!learns_) return;
  const Keyframe& to = *map.FindKeyframe(newest);
  int num_partners = 0;
  for (const Map::Covisible& other : map.FindCovisible(newest)) {
    const auto estimate =
        EstimateReadout(map, *map.FindKeyframe(other.keyframe), to, readout_time_);
    if (!estimate) continue;
    information_ += estimate->information - information_ / kMemory;
    weighted_sum_ += estimate->information * estimate->readout_time - weighted_sum_ / kMemory;
    if (++num_partners == kMaxPartners) break;
  }
  if (information_ > 0.0) Decide();
}

void ReadoutEstimator::Decide() {
  const double estimate = weighted_sum_ / information_;
  if (readout_time_ == 0.0) {
    if (std::abs(estimate) * std::sqrt(information_) < kCertain) return;
    if (std::abs(estimate) < kMinReadout) return;
    information_ = 1.0 / Square(kFirstSigma);
    weighted_sum_ = information_ * estimate;
  }
  readout_time_ = std::abs(estimate) < 0.5 * kMinReadout
                      ? 0.0
                      : std::clamp(estimate, -kMaxReadout, kMaxReadout);
}

}  // namespace msc_vo
