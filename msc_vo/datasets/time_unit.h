// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

/// Units of the time stamps of recordings.
enum class TimeUnit {
  kSeconds,
  kMilliseconds,
  kMicroseconds,
  kNanoseconds,
  kHundredNanoseconds,  ///< ticks of Windows since 1601 and of .NET since the year 1
};

/// Returns the name of the unit in the plural, "seconds".
const char* ToString(TimeUnit unit);
/// Returns the number of units in one second, 1e3 for milliseconds.
double UnitsPerSecond(TimeUnit unit);

/// Returns the median interval of stamps in any order, in the unit of the stamps; 0 for fewer than
/// two.
double MedianInterval(std::vector<double> stamps);

/// The time range that a list of stamps covers, and the original unit of the list.
struct TimeRange {
  double begin = 0.0;  ///< seconds
  double end = 0.0;    ///< seconds
  TimeUnit unit = TimeUnit::kSeconds;
};

/// Returns the range of stamps that have been converted from `unit` to seconds; zero if there are
/// none.
TimeRange RangeOf(const std::vector<double>& seconds, TimeUnit unit);

/// Returns the unit in which the stamp is a date of this century, in time since 1970 or since the
/// epoch of the unit; none if there is no such unit.
std::optional<TimeUnit> UnitOfDate(double stamp);

/// Smallest interval of the images of an RGB-D camera, seconds.
constexpr double kMinImageInterval = 1.0 / 120.0;
/// Largest median interval of the images of a recording, seconds; far above that of any camera.
constexpr double kMaxImageInterval = 5.0;
/// The same for the poses of a trajectory, which may be sparse.
constexpr double kMaxPoseInterval = 3600.0;

/// Guesses the unit of the stamps of a recording, which may be in any order: the unit in which they
/// are dates of this century at a median interval of less than `max_interval` seconds, or else the
/// first one in which the interval is below kMaxImageInterval. If `reference` is given, the range
/// of other stamps of the same recording, another unit takes precedence if the two ranges overlap
/// more in it: that of the reference; or any in which most of both is common, with an interval of
/// 0.25 ms to kMaxImageInterval, as 4 milliseconds look like 4 seconds.
TimeUnit GuessTimeUnit(const std::vector<double>& stamps,
                       const std::optional<TimeRange>& reference = std::nullopt,
                       double max_interval = kMaxPoseInterval);

/// Describes a doubt about the unit of the stamps of images whose median interval it makes longer
/// than 0.2 s: ", 3.0 images per second; ..."; empty if there is none.
std::string DescribeSlowRate(double interval);

/// Returns the intersection over union of two time ranges, 0..1.
double Overlap(const TimeRange& a, const TimeRange& b);

/// Returns the step in which numbers, in any order, count: their smallest step, if all steps are
/// multiples of it. None if they do not count, or fewer than two differ.
std::optional<double> CountingStep(std::vector<double> numbers);

/// Tests whether whole numbers count frames rather than milliseconds: their median step would be
/// too short between images (kMinImageInterval), or they count every nth frame from 0 or 1, while a
/// clock has any origin.
bool AreFrameCounts(const std::vector<double>& numbers);

/// Tests whether the stamps may be frame numbers: whole numbers with steps of at most 60.
bool AreFrameNumbers(const std::vector<double>& stamps);

}  // namespace msc_vo
