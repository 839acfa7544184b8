// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/time_unit.h"

namespace msc_vo {

/// How sure it is that a number in the names of images is a time.
enum class NamedTimes {
  kNone,
  kPossible,  ///< numbers with a constant step, which may count frames or milliseconds
  kCertain,
};

/// The images of one stream and what the numbers in their names tell.
struct NamedImages {
  std::vector<std::string> paths;
  NamedTimes certainty = NamedTimes::kNone;
  std::vector<double> times;  ///< of the paths, seconds; empty: none
  TimeUnit unit = TimeUnit::kSeconds;
  std::vector<int64_t> numbers;  ///< frame numbers of the paths, all different; empty: none
  /// What the names tell, for messages: "times from 1.5 to 9.3 s".
  std::string description;
  std::vector<std::string> warnings;  ///< on how the names were read
};

/// Reads the numbers in the names of the images, which are in natural order. The numbers of all
/// names together decide what they are, because a single number may be anything:
///  - a date and a time of day with a fraction of the second, see ReadCalendarTime();
///  - a time since 1970, since the start of the machine or since that of the recording, in seconds
///    with decimals, in "<seconds>_<nanoseconds>" or in a whole number of any TimeUnit;
///  - a frame number: whole numbers whose steps are multiples of the smallest step.
/// Images whose names have another pattern than most are left out, with a warning. `reference` is
/// the time range of the other stream, if it has one.
NamedImages ReadImageNames(const std::vector<std::string>& paths,
                           const std::optional<TimeRange>& reference = std::nullopt);

}  // namespace msc_vo
