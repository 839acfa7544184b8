// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calendar_time.h"

#include <ctime>

namespace msc_vo {

namespace {

// A field of a date or a time of day.
struct Field {
  size_t num_digits;
  int min;
  int max;
};

constexpr Field kFields[] = {{4, 2000, 2099}, {2, 1, 12}, {2, 1, 31},
                             {2, 0, 23},      {2, 0, 59}, {2, 0, 60}};

}  // namespace

std::optional<CalendarTime> ReadCalendarTime(const NameParts& name, size_t first_run) {
  size_t run = first_run, at = 0;  // position in the run
  int values[6] = {};
  for (size_t i = 0; i < 6; ++i) {
    const Field& field = kFields[i];
    if (run < name.digits.size() && at == name.digits[run].size()) {
      ++run;
      at = 0;
    }
    if (run >= name.digits.size()) return std::nullopt;
    const std::string& digits = name.digits[run];
    const bool is_unpadded = i > 0 && digits.size() == 1;  // "2023-5-1"
    const size_t count = is_unpadded ? 1 : field.num_digits;
    if (digits.size() < at + count) return std::nullopt;
    values[i] = std::stoi(digits.substr(at, count));
    if (values[i] < field.min || values[i] > field.max) return std::nullopt;
    at += count;
  }
  std::tm time = {};
  time.tm_year = values[0] - 1900;
  time.tm_mon = values[1] - 1;
  time.tm_mday = values[2];
  time.tm_hour = values[3];
  time.tm_min = values[4];
  time.tm_sec = values[5];
  return CalendarTime{timegm(&time), name.digits[run].substr(at), run};
}

}  // namespace msc_vo
