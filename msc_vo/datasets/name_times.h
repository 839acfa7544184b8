// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/datasets/time_unit.h"

namespace msc_vo {

/// Times in the names of the images of one stream.
struct NameTimes {
  std::vector<double> seconds;  ///< of each name
  TimeUnit unit = TimeUnit::kSeconds;
  bool is_calendar = false;  ///< dates with a time of day, read as UTC
  bool is_date = false;      ///< times since 1970
  bool is_certain = true;    ///< false: the numbers may be frame numbers
  size_t first_run = 0;      ///< runs of digits that encode the time
  size_t last_run = 0;
};

/// Finds the runs of digits that encode times, in names in natural order with equally many runs.
/// The times are almost all different, at intervals that a camera may have, and ascend with the
/// numbers before them. `reference` is the time range of the other stream, if it has one. Adds a
/// warning if the names hold dates that cannot be used. None if there are no times.
std::optional<NameTimes> FindTimes(const std::vector<NameParts>& names,
                                   const std::optional<TimeRange>& reference,
                                   std::vector<std::string>* warnings);

}  // namespace msc_vo
