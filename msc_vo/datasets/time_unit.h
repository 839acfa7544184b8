// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

namespace msc_vo {

// Units in which recorders count time.
enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };

const char* ToString(TimeUnit unit);  // "seconds"
double UnitsPerSecond(TimeUnit unit);

// The time that a list of stamps covers, and the unit in which the list counts it.
struct TimeRange {
  double begin = 0.0;  // seconds
  double end = 0.0;    // seconds
  TimeUnit unit = TimeUnit::kSeconds;
};
// Of stamps that have been brought from `unit` to seconds; all zero if there are none.
TimeRange RangeOf(const std::vector<double>& seconds, TimeUnit unit);

// The unit in which the stamp is a date of this century; none: it is none in any unit.
std::optional<TimeUnit> UnitOfDate(double stamp);

// The unit of the stamps of a recording, in any order: the one in which they are dates of this
// century, or else the one in which images or poses are less than 5 s apart (median).
TimeUnit GuessTimeUnit(const std::vector<double>& stamps);

// As above for stamps that should cover the time of `reference`: its unit, if that brings the two
// closer together.
TimeUnit GuessTimeUnit(const std::vector<double>& stamps, const TimeRange& reference);

}  // namespace msc_vo
