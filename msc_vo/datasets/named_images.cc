// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/named_images.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/datasets/name_times.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

using Names = std::vector<NameParts>;

// Whether the run of digits is the fraction of the run before it.
bool IsFraction(const NameParts& name, size_t run, bool is_behind_fraction) {
  return run > 0 && name.texts[run] == "." && !is_behind_fraction;
}

// Returns the text of the name with # for every number, which may have a fraction: "img_#_#".
std::string PatternOf(const NameParts& name) {
  std::string pattern = name.texts.front();
  bool is_fraction = false;
  for (size_t run = 0; run < name.digits.size(); ++run) {
    is_fraction = IsFraction(name, run, is_fraction);
    if (is_fraction) pattern.pop_back();  // the point
    pattern += (is_fraction ? "" : "#") + name.texts[run + 1];
  }
  return pattern;
}

// Adds the fraction 0 to numbers without one.
NameParts WithFractions(const NameParts& name) {
  NameParts all;
  all.texts.push_back(name.texts.front());
  bool is_fraction = false;
  for (size_t run = 0; run < name.digits.size(); ++run) {
    is_fraction = IsFraction(name, run, is_fraction);
    all.digits.push_back(name.digits[run]);
    all.texts.push_back(name.texts[run + 1]);
    const bool has_fraction =
        run + 1 < name.digits.size() && IsFraction(name, run + 1, is_fraction);
    if (is_fraction || has_fraction) continue;
    all.digits.push_back("0");
    all.texts.insert(all.texts.end() - 1, ".");
  }
  return all;
}

// Keeps the images whose names have the most frequent pattern, if they are most images. Returns the
// parts of their names, all with equally many runs of digits; empty if there is no such pattern.
Names KeepPattern(NamedImages* images) {
  std::map<std::string, std::vector<std::string>> paths_of_pattern;
  for (const std::string& path : images->paths) {
    paths_of_pattern[PatternOf(SplitName(StemOf(path)))].push_back(path);
  }
  const auto largest = std::max_element(
      paths_of_pattern.begin(), paths_of_pattern.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  const size_t num_kept = largest->second.size(), num_all = images->paths.size();
  if (largest->first.find('#') == std::string::npos || 2 * num_kept <= num_all) return {};
  if (num_kept < num_all) {
    const auto other =
        paths_of_pattern.begin() == largest ? std::next(largest) : paths_of_pattern.begin();
    images->warnings.push_back(
        FormatText("%zu of %zu images are left out, because their names are not like the others, "
                   "%s; the first one is %s",
                   num_all - num_kept, num_all, largest->first.c_str(),
                   fs::path(other->second.front()).filename().string().c_str()));
  }
  images->paths = largest->second;
  Names names;
  for (const std::string& path : images->paths) names.push_back(SplitName(StemOf(path)));
  const size_t num_runs = names.front().digits.size();
  const bool is_uniform = std::all_of(names.begin(), names.end(), [&](const NameParts& name) {
    return name.digits.size() == num_runs;
  });
  if (is_uniform) return names;
  std::transform(names.begin(), names.end(), names.begin(), WithFractions);
  return names;
}

// The numbers of a run of digits; empty if they do not ascend in the order of the names, as those
// of a counter do, or are too large.
std::vector<double> KeysOf(const Names& names, size_t run) {
  constexpr size_t kMaxDigits = 15;  // a double represents them exactly
  std::vector<double> keys;
  for (const NameParts& name : names) {
    if (name.digits[run].size() > kMaxDigits) return {};
    keys.push_back(*ParseNumber(name.digits[run]));
    if (keys.size() > 1 && keys.back() <= keys[keys.size() - 2]) return {};
  }
  return keys;
}

// Takes the last run of digits, outside the times, that numbers the images.
void ReadNumbers(const Names& names, const std::optional<NameTimes>& times, NamedImages* images) {
  constexpr char kUneven[] =
      "the numbers in the names have uneven steps; they are read as frame numbers";
  bool count_frames = false;
  for (size_t run = names.front().digits.size(); run-- > 0 && !count_frames;) {
    const bool is_time =
        times && times->is_certain && run >= times->first_run && run <= times->last_run;
    const std::vector<double> keys = is_time ? std::vector<double>() : KeysOf(names, run);
    count_frames = keys.size() == 1 || CountingStep(keys);
    if (keys.empty() || (!count_frames && !images->numbers.empty())) continue;
    images->numbers.assign(keys.begin(), keys.end());
  }
  if (!images->numbers.empty() && !count_frames && !images->times.empty()) images->numbers.clear();
  if (!images->numbers.empty() && !count_frames) images->warnings.push_back(kUneven);
}

void Describe(const NameTimes* times, NamedImages* images) {
  if (times != nullptr && times->is_certain) {
    const auto [first, last] = std::minmax_element(images->times.begin(), images->times.end());
    images->description = FormatText("times from %.3f to %.3f s", *first, *last);
  } else if (!images->numbers.empty()) {
    const auto [first, last] = std::minmax_element(images->numbers.begin(), images->numbers.end());
    images->description = FormatText("frame numbers from %lld to %lld",
                                     static_cast<long long>(*first), static_cast<long long>(*last));
  }
}

// Says how the times were read, unless they are plain seconds.
void WarnAboutUnit(const NameTimes& times, NamedImages* images) {
  if (times.is_calendar) {
    images->warnings.push_back("the names hold dates and times of day, which are read as UTC");
  } else if (times.unit != TimeUnit::kSeconds) {
    images->warnings.push_back(
        std::string("the names hold times in ") + ToString(times.unit) +
        (times.is_date && times.unit != TimeUnit::kHundredNanoseconds ? " since 1970" : "") +
        ", which are converted to seconds" +
        (times.is_date ? "" : DescribeSlowRate(MedianInterval(times.seconds))));
  }
}

}  // namespace

NamedImages ReadImageNames(const std::vector<std::string>& paths,
                           const std::optional<TimeRange>& reference) {
  NamedImages images;
  images.paths = paths;
  images.description = "nothing that is understood as a time or a frame number";
  if (paths.empty()) return images;
  const Names names = KeepPattern(&images);
  if (names.empty()) return images;
  const std::optional<NameTimes> times = FindTimes(names, reference, &images.warnings);
  if (times) {
    images.certainty = times->is_certain ? NamedTimes::kCertain : NamedTimes::kPossible;
    images.times = times->seconds;
    images.unit = times->unit;
    if (times->is_certain) WarnAboutUnit(*times, &images);
  }
  ReadNumbers(names, times, &images);
  Describe(times ? &*times : nullptr, &images);
  return images;
}

}  // namespace msc_vo
