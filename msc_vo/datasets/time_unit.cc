// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/time_unit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/text/enum_names.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// The units that intervals distinguish. Ticks of 100 ns are recognised as dates only.
constexpr TimeUnit kUnits[] = {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                               TimeUnit::kNanoseconds};

// Shortest median interval of the poses of a trajectory or of the readings of a sensor, seconds. No
// accelerometer is faster, and seconds at more than 4 Hz are not taken for milliseconds.
constexpr double kMinInterval = 2.5e-4;

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
  return EnumName<TimeUnit::kHundredNanoseconds>(
      unit, {"seconds", "milliseconds", "microseconds", "nanoseconds", "units of 100 nanoseconds"});
}

double UnitsPerSecond(TimeUnit unit) {
  constexpr double kRates[] = {1.0, 1e3, 1e6, 1e9, 1e7};
  static_assert(std::size(kRates) == static_cast<size_t>(TimeUnit::kHundredNanoseconds) + 1);
  return kRates[static_cast<size_t>(unit)];
}

double MedianInterval(std::vector<double> stamps) {
  if (stamps.size() < 2) return 0.0;
  std::sort(stamps.begin(), stamps.end());
  std::vector<double> intervals;
  for (size_t i = 1; i < stamps.size(); ++i) intervals.push_back(stamps[i] - stamps[i - 1]);
  return UpperMedian(std::move(intervals));
}

TimeRange RangeOf(const std::vector<double>& seconds, TimeUnit unit) {
  if (seconds.empty()) return {0.0, 0.0, unit};
  const auto [first, last] = std::minmax_element(seconds.begin(), seconds.end());
  return {*first, *last, unit};
}

std::optional<TimeUnit> UnitOfDate(double stamp) {
  constexpr double kYear2000 = 946684800.0;   // seconds since 1970
  constexpr double kYear2100 = 4102444800.0;  // seconds since 1970
  constexpr double kYear1 = -62135596800.0, kYear1601 = -11644473600.0;
  const auto is_date = [&](TimeUnit unit, double epoch) {
    const double seconds = stamp / UnitsPerSecond(unit) + epoch;
    return seconds >= kYear2000 && seconds < kYear2100;
  };
  for (const TimeUnit unit : kUnits) {
    if (is_date(unit, 0.0)) return unit;
  }
  for (const double epoch : {kYear1, kYear1601}) {
    if (is_date(TimeUnit::kHundredNanoseconds, epoch)) return TimeUnit::kHundredNanoseconds;
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

std::string DescribeSlowRate(double interval) {
  constexpr double kLongInterval = 0.2;  // seconds; RGB-D cameras rarely have fewer images
  if (interval <= kLongInterval) return "";
  return FormatText(
      ", %.1f images per second; if there were more, the unit is another one: write the times in "
      "seconds",
      1.0 / interval);
}

double Overlap(const TimeRange& a, const TimeRange& b) {
  const double common = std::min(a.end, b.end) - std::max(a.begin, b.begin);
  const double all = std::max(a.end, b.end) - std::min(a.begin, b.begin);
  return all > 0.0 ? std::max(common, 0.0) / all : 1.0;
}

std::optional<double> CountingStep(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  if (numbers.size() < 2) return std::nullopt;
  double smallest = numbers[1] - numbers[0];
  for (size_t i = 2; i < numbers.size(); ++i) {
    smallest = std::min(smallest, numbers[i] - numbers[i - 1]);
  }
  for (const double number : numbers) {
    if (std::fmod(number - numbers[0], smallest) != 0.0) return std::nullopt;
  }
  return smallest;
}

bool AreFrameCounts(const std::vector<double>& numbers) {
  const std::optional<double> step = CountingStep(numbers);
  if (!step) return false;
  return MedianInterval(numbers) < 1e3 * kMinImageInterval ||
         std::fmod(numbers.front(), *step) <= 1.0;
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
