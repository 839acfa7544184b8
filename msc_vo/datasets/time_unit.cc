// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/time_unit.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/datasets/median_interval.h"

namespace msc_vo {

namespace {

constexpr TimeUnit kUnits[] = {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                               TimeUnit::kNanoseconds};

// Shortest median interval of the poses of a trajectory or of the readings of a sensor, seconds. No
// accelerometer is faster, and seconds at more than 4 Hz are not taken for milliseconds.
constexpr double kMinInterval = 2.5e-4;

// Intersection over union of two time ranges, 0..1.
double Overlap(const TimeRange& a, const TimeRange& b) {
  const double common = std::min(a.end, b.end) - std::max(a.begin, b.begin);
  const double all = std::max(a.end, b.end) - std::min(a.begin, b.begin);
  return all > 0.0 ? std::max(common, 0.0) / all : 1.0;
}

// The unit of stamps in which their median interval is plausible.
TimeUnit GuessOwnUnit(const std::vector<double>& stamps, double max_interval) {
  if (stamps.empty()) return TimeUnit::kSeconds;
  const double interval = MedianInterval(stamps);
  // Times since boot are a date in a larger unit during part of the uptime: nanoseconds in the
  // first hours, milliseconds from the eleventh day. The interval distinguishes the two.
  const std::optional<TimeUnit> date = UnitOfDate(stamps.front());
  if (date && interval / UnitsPerSecond(*date) < max_interval) return *date;
  for (const TimeUnit unit : kUnits) {
    if (interval / UnitsPerSecond(unit) < kMaxImageInterval) return unit;
  }
  return TimeUnit::kNanoseconds;
}

}  // namespace

const char* ToString(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kSeconds:
      return "seconds";
    case TimeUnit::kMilliseconds:
      return "milliseconds";
    case TimeUnit::kMicroseconds:
      return "microseconds";
    case TimeUnit::kNanoseconds:
      return "nanoseconds";
  }
  return "unknown";
}

double UnitsPerSecond(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kSeconds:
      return 1.0;
    case TimeUnit::kMilliseconds:
      return 1e3;
    case TimeUnit::kMicroseconds:
      return 1e6;
    case TimeUnit::kNanoseconds:
      return 1e9;
  }
  return 1.0;
}

TimeRange RangeOf(const std::vector<double>& seconds, TimeUnit unit) {
  if (seconds.empty()) return {0.0, 0.0, unit};
  const auto [first, last] = std::minmax_element(seconds.begin(), seconds.end());
  return {*first, *last, unit};
}

std::optional<TimeUnit> UnitOfDate(double stamp) {
  constexpr double kYear2000 = 946684800.0;   // seconds since 1970
  constexpr double kYear2100 = 4102444800.0;  // seconds since 1970
  for (const TimeUnit unit : kUnits) {
    const double seconds = stamp / UnitsPerSecond(unit);
    if (seconds >= kYear2000 && seconds < kYear2100) return unit;
  }
  return std::nullopt;
}

TimeUnit GuessTimeUnit(const std::vector<double>& stamps, const std::optional<TimeRange>& reference,
                       double max_interval) {
  const TimeUnit own = GuessOwnUnit(stamps, max_interval);
  if (!reference || stamps.empty()) return own;
  const TimeRange counted = RangeOf(stamps, own);
  const auto overlap_in = [&](TimeUnit unit) {
    const double rate = UnitsPerSecond(unit);
    return Overlap({counted.begin / rate, counted.end / rate, unit}, *reference);
  };
  const double interval = MedianInterval(stamps);
  TimeUnit best = own;
  if (overlap_in(reference->unit) > overlap_in(own)) best = reference->unit;
  for (const TimeUnit unit : kUnits) {
    const double seconds = interval / UnitsPerSecond(unit);
    const bool is_plausible = seconds >= kMinInterval && seconds < kMaxImageInterval;
    const double overlap = overlap_in(unit);
    if (is_plausible && overlap > 0.5 && overlap > overlap_in(best)) best = unit;
  }
  return best;
}

bool AreFrameNumbers(const std::vector<double>& stamps) {
  constexpr double kMaxStep = 60.0;        // two seconds without an image at 30 Hz
  constexpr double kMaxFrameNumber = 1e8;  // a month at 30 Hz; below any date of UnitOfDate()
  for (size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i] != std::floor(stamps[i]) || std::abs(stamps[i]) > kMaxFrameNumber) return false;
    if (i > 0 && std::abs(stamps[i] - stamps[i - 1]) > kMaxStep) return false;
  }
  return stamps.size() > 1;
}

}  // namespace msc_vo
