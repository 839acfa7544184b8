// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "msc_vo/datasets/image_name.h"

namespace msc_vo {

/// A date and a time of day in the name of an image.
struct CalendarTime {
  int64_t seconds = 0;   ///< since 1970, the time read as UTC
  std::string fraction;  ///< digits that follow the seconds in the same run; may be empty
  size_t last_run = 0;   ///< run of digits that holds the seconds
};

/// Reads year, month, day, hour, minute and second from the runs of digits that begin with
/// `first_run`: "2023-05-01_12-30-15", "20230501T123015", "20230501123015123". Other text may
/// separate the runs. None if the digits are no date of this century with a time of day.
std::optional<CalendarTime> ReadCalendarTime(const NameParts& name, size_t first_run);

}  // namespace msc_vo
