// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <chrono>

namespace msc_vo {

/// Milliseconds since its construction or the last Restart().
class Stopwatch {
 public:
  double Milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  /// Returns the time so far and starts again.
  double Restart() {
    const double milliseconds = Milliseconds();
    start_ = Clock::now();
    return milliseconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Runs `step`, adds its time to *milliseconds, and returns its result.
template <typename Step>
auto Timed(double* milliseconds, const Step& step) {
  struct Meter {
    ~Meter() { *milliseconds += stopwatch.Milliseconds(); }
    double* milliseconds;
    Stopwatch stopwatch;
  };
  const Meter meter{milliseconds, {}};
  return step();
}

}  // namespace msc_vo
