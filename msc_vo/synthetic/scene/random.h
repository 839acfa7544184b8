// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

/// Mixes the bits of a word (finaliser of SplitMix64).
inline uint64_t MixBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// A seeded random number generator (SplitMix64) with the same sequence on every platform.
class Random {
 public:
  /// The streams of one seed are independent, e.g. one per frame.
  explicit Random(uint64_t seed, uint64_t stream = 0) : state_(MixBits(seed) ^ MixBits(~stream)) {}

  uint64_t Next() { return MixBits(state_ += 0x9e3779b97f4a7c15ULL); }
  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Uniform in 0 .. count - 1; count must be positive.
  int Index(int count) { return static_cast<int>(Uniform() * count); }
  /// Standard normal (Box-Muller, which generates two deviates at a time).
  double Normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    const double angle = 2.0 * kPi * Uniform();
    has_spare_ = true;
    spare_ = radius * std::sin(angle);
    return radius * std::cos(angle);
  }
  Eigen::Vector2d Normal2() {
    const double x = Normal();
    return {x, Normal()};
  }
  Eigen::Vector3d Normal3() {
    const Eigen::Vector2d xy = Normal2();
    return {xy.x(), xy.y(), Normal()};
  }

  /// Poisson deviate of a `mean` >= 0: by inversion, above 30 by its normal approximation.
  int Poisson(double mean) {
    if (mean > 30.0)
      return std::max(0, static_cast<int>(std::lround(mean + std::sqrt(mean) * Normal())));
    const double uniform = Uniform();
    double probability = std::exp(-mean), sum = probability;
    int count = 0;
    for (; sum < uniform && count < 200; sum += probability) probability *= mean / ++count;
    return count;
  }

 private:
  uint64_t state_;
  bool has_spare_ = false;
  double spare_ = 0.0;
};

}  // namespace msc_vo
