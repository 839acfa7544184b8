// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/name_times.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <set>
#include <utility>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

using Names = std::vector<NameParts>;
using Texts = std::vector<std::string>;

// A column of numbers that may be times.
struct Candidate {
  Texts texts;  // one decimal number per name
  size_t first_run = 0;
  size_t last_run = 0;
  bool is_calendar = false;
  bool has_seconds = false;  // whole seconds and a fraction of them
};

Texts Column(const Names& names, size_t run) {
  Texts column;
  for (const NameParts& name : names) column.push_back(name.digits[run]);
  return column;
}

std::vector<double> Numbers(const Texts& texts) {
  std::vector<double> numbers;
  for (const std::string& text : texts) numbers.push_back(ParseNumber(text).value_or(HUGE_VAL));
  return numbers;
}

bool IsStrictlyAscending(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

// Number of steps that are equal to the median step within 20 %, as those of a camera are.
size_t CountRegularSteps(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const double median = MedianInterval(numbers);
  size_t count = 0;
  for (size_t i = 1; i < numbers.size(); ++i) {
    if (std::abs(numbers[i] - numbers[i - 1] - median) <= 0.2 * median) ++count;
  }
  return count;
}

bool IsPoint(const std::string& separator) { return separator == "." || separator == ","; }

Texts WithDecimals(const Texts& seconds, const Texts& decimals) {
  Texts texts;
  for (size_t i = 0; i < seconds.size(); ++i) texts.push_back(seconds[i] + "." + decimals[i]);
  return texts;
}

// Appends the fraction in another column to whole seconds. Digits of one width are decimals as they
// are. Others are a whole number of milliseconds, microseconds or nanoseconds, or, behind a point,
// possibly decimals without zeros at the end; the reading with more regular steps is returned.
Texts AppendFraction(const Texts& seconds, const Texts& column, bool is_behind_point) {
  const bool is_fixed = std::all_of(column.begin(), column.end(), [&](const std::string& digits) {
    return digits.size() == column.front().size();
  });
  const Texts decimals = WithDecimals(seconds, column);
  if (is_fixed) return decimals;
  const Texts padded = WithDecimals(seconds, PadFractions(column));
  const bool are_decimals =
      is_behind_point && CountRegularSteps(Numbers(decimals)) >= CountRegularSteps(Numbers(padded));
  return are_decimals ? decimals : padded;
}

// A date and a time of day in the name of an image.
struct CalendarTime {
  int64_t seconds = 0;   // since 1970, the time read as UTC
  std::string fraction;  // digits that follow the seconds in the same run; may be empty
  size_t last_run = 0;   // run of digits that holds the seconds
};

// A field of a date or a time of day.
struct DateField {
  size_t num_digits;
  int min;
  int max;
};

constexpr DateField kDateFields[] = {{4, 2000, 2099}, {2, 1, 12}, {2, 1, 31},
                                     {2, 0, 23},      {2, 0, 59}, {2, 0, 60}};

// Reads year, month, day, hour, minute and second from the runs of digits that begin with
// `first_run`: "2023-05-01_12-30-15", "20230501T123015", "20230501123015123". Other text may
// separate the runs. None if the digits are no date of this century with a time of day.
std::optional<CalendarTime> ReadCalendarTime(const NameParts& name, size_t first_run) {
  size_t run = first_run, at = 0;  // position in the run
  int values[6] = {};
  for (size_t i = 0; i < 6; ++i) {
    const DateField& field = kDateFields[i];
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

// Whether the numbers count the images of each second, as those of a burst do: they ascend by one
// or restart, and end far below the next second.
bool CountWithinSeconds(const Texts& seconds, const Texts& column) {
  constexpr double kFarBelow = 0.9;  // of a second: fractions would come closer to the next one
  double largest = 0.0;
  const std::vector<double> numbers = Numbers(column);
  for (size_t i = 0; i < numbers.size(); ++i) {
    largest = std::max(largest, numbers[i] / std::pow(10.0, column[i].size()));
    const bool same_second = i > 0 && seconds[i] == seconds[i - 1];
    if (same_second && numbers[i] != numbers[i - 1] + 1.0) return false;
    if (!same_second && numbers[i] > 1.0) return false;
  }
  return largest < kFarBelow;
}

// The date and the time of day that begin with a run, if all names have them there.
std::optional<Candidate> ReadCalendar(const Names& names, size_t first_run) {
  Candidate candidate;
  candidate.first_run = first_run;
  candidate.is_calendar = candidate.has_seconds = true;
  Texts seconds, fractions;
  for (const NameParts& name : names) {
    const std::optional<CalendarTime> time = ReadCalendarTime(name, first_run);
    if (!time || (!seconds.empty() && time->last_run != candidate.last_run)) return std::nullopt;
    candidate.last_run = time->last_run;
    seconds.push_back(std::to_string(time->seconds));
    fractions.push_back(time->fraction);
  }
  const bool has_fraction = std::none_of(fractions.begin(), fractions.end(),
                                         [](const std::string& text) { return text.empty(); });
  const size_t next = candidate.last_run + 1;
  if (has_fraction) {
    candidate.texts = WithDecimals(seconds, fractions);
  } else if (next < names.front().digits.size() &&
             !CountWithinSeconds(seconds, Column(names, next))) {
    const bool is_behind_point = IsPoint(names.front().texts[next]);
    candidate.texts = AppendFraction(seconds, Column(names, next), is_behind_point);
    candidate.last_run = next;
  } else {
    candidate.texts = seconds;
  }
  return candidate;
}

// Whether a run may hold the whole seconds of the fraction in the next run: a date, or a number
// that several images have in common.
bool MayHaveFraction(const Names& names, size_t run) {
  const std::vector<double> seconds = Numbers(Column(names, run));
  if (UnitOfDate(seconds.front()) == TimeUnit::kSeconds) return true;
  const size_t width = names.front().digits[run + 1].size();
  const bool has_unit = width == 3 || width == 6 || width == 9;
  const bool varies = seconds.front() != seconds.back();
  return has_unit && (varies || width > 3) && !IsStrictlyAscending(seconds);
}

std::vector<Candidate> ListCandidates(const Names& names) {
  std::vector<Candidate> candidates;
  const size_t num_runs = names.front().digits.size();
  for (size_t run = 0; run < num_runs; ++run) {
    if (auto calendar = ReadCalendar(names, run)) candidates.push_back(std::move(*calendar));
  }
  for (size_t run = 0; run < num_runs; ++run) {
    const Texts column = Column(names, run);
    if (run + 1 < num_runs) {
      const bool is_behind_point = IsPoint(names.front().texts[run + 1]);
      if (is_behind_point || MayHaveFraction(names, run)) {
        candidates.push_back({AppendFraction(column, Column(names, run + 1), is_behind_point), run,
                              run + 1, false, !is_behind_point});
      }
    }
    candidates.push_back({column, run, run, false, false});
  }
  return candidates;
}

// Whether the stamps can be those of a camera: hardly any is repeated, and the median interval is
// that of a camera. It exceeds the milliseconds of a counter that is taken for decimals of seconds.
bool AreUsable(const std::vector<double>& seconds) {
  constexpr double kMinInterval = 0.0015;  // seconds
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const auto num_different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  const auto num_repeated = static_cast<std::ptrdiff_t>(seconds.size()) - num_different;
  if (10 * num_repeated > static_cast<std::ptrdiff_t>(seconds.size())) return false;
  const double interval = MedianInterval(seconds);
  return seconds.size() < 2 || (interval >= kMinInterval && interval <= kMaxImageInterval);
}

// How sure it is that whole numbers, which are no dates, are times.
enum class Certainty { kNo, kPossible, kYes };
Certainty AreTimes(const std::vector<double>& numbers) {
  constexpr double kMaxFrameStep = 60.0;  // two seconds without an image at 30 Hz
  const double median = MedianInterval(numbers);
  if (numbers.size() < 3 || median < 1e3 * kMinImageInterval) return Certainty::kNo;
  if (median > kMaxFrameStep) return Certainty::kYes;
  const bool repeats = std::set<double>(numbers.begin(), numbers.end()).size() < numbers.size();
  if (repeats || !CountingStep(numbers)) {
    const bool is_regular = 2 * CountRegularSteps(numbers) + 1 >= numbers.size();
    return is_regular ? Certainty::kYes : Certainty::kNo;
  }
  return AreFrameCounts(numbers) ? Certainty::kPossible : Certainty::kYes;
}

// Whether the times do not ascend although a number before them does, such as a counter or the
// minutes of a time of day.
bool ContradictsOrder(const Names& names, const NameTimes& times) {
  if (std::is_sorted(times.seconds.begin(), times.seconds.end())) return false;
  for (size_t run = 0; run < times.first_run; ++run) {
    const std::string& first = names.front().digits[run];
    const bool varies = std::any_of(names.begin(), names.end(), [&](const NameParts& name) {
      return name.digits[run] != first;
    });
    if (varies) return true;
  }
  return false;
}

std::optional<NameTimes> ReadTimes(const Candidate& candidate,
                                   const std::optional<TimeRange>& reference) {
  std::vector<double> numbers = Numbers(candidate.texts);
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (!std::all_of(numbers.begin(), numbers.end(), is_finite)) return std::nullopt;
  NameTimes times;
  times.first_run = candidate.first_run;
  times.last_run = candidate.last_run;
  times.is_calendar = candidate.is_calendar;
  if (!candidate.has_seconds) {
    times.unit = GuessTimeUnit(numbers, reference, kMaxImageInterval);
  }
  const double rate = UnitsPerSecond(times.unit);
  times.is_date = UnitOfDate(numbers.front()) == times.unit;
  const bool is_whole = candidate.texts.front().find('.') == std::string::npos;
  if (is_whole && !times.is_date) {
    const Certainty certainty = AreTimes(numbers);
    if (certainty == Certainty::kNo) return std::nullopt;
    times.is_certain = certainty == Certainty::kYes;
  }
  for (double& number : numbers) number /= rate;
  times.seconds = std::move(numbers);
  return times;
}

}  // namespace

std::optional<NameTimes> FindTimes(const Names& names, const std::optional<TimeRange>& reference,
                                   std::vector<std::string>* warnings) {
  std::optional<NameTimes> best;
  bool has_unusable_dates = false;
  const auto rank = [](const NameTimes& times) {
    return times.is_date ? 2 : times.is_certain ? 1 : 0;
  };
  for (const Candidate& candidate : ListCandidates(names)) {
    std::optional<NameTimes> times = ReadTimes(candidate, reference);
    if (!times) continue;
    if (!AreUsable(times->seconds) || ContradictsOrder(names, *times)) {
      // A name may also hold the date of the recording, or a serial number.
      const bool varies = std::floor(times->seconds.front()) != std::floor(times->seconds.back());
      has_unusable_dates = has_unusable_dates || (times->is_date && varies);
    } else if (!best || rank(*times) > rank(*best)) {
      best = std::move(times);
    }
  }
  if (has_unusable_dates && !(best && best->is_date)) {
    warnings->push_back(
        "the dates in the names are not used, because they repeat, go backwards or have whole "
        "seconds only");
  }
  return best;
}

}  // namespace msc_vo
