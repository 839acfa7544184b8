// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_times.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Seconds: half of the last of two decimals, and the rounding of the sum.
constexpr double kTimeRounding = 0.0055;

// Tests whether the first number of each line counts the lines, and a time follows.
bool AreNumbered(const std::vector<TextLine>& lines) {
  std::optional<double> previous;
  for (const TextLine& line : lines) {
    if (line.fields.size() < 2 || !ParseNumber(line.fields[1])) return false;
    const std::optional<double> number = ParseNumber(line.fields[0]);
    if (!number || (previous && *number != *previous + 1.0)) return false;
    previous = number;
  }
  return lines.size() > 1;
}

void SetTimes(const std::vector<double>& times, SequenceIndex* index) {
  for (size_t i = 0; i < times.size(); ++i) index->entries[i].timestamp = times[i];
  index->has_assumed_times = false;
}

// Seconds from each image to its pose.
std::vector<double> DifferencesOf(const std::vector<double>& times, const SequenceIndex& index) {
  std::vector<double> differences;
  for (size_t i = 0; i < times.size(); ++i) {
    differences.push_back(times[i] - index.entries[i].timestamp);
  }
  return differences;
}

}  // namespace

std::string FindTimesFile(const std::string& directory) {
  return FirstEntry(directory, {"times.txt", "timestamps.txt"});
}

std::vector<double> ReadTimesFile(const std::string& path) {
  std::vector<TextLine> lines = ReadTextLines(path);
  const size_t column = AreNumbered(lines) ? 1 : 0;
  RestoreFractions(column, &lines);
  std::vector<double> times;
  for (const TextLine& line : lines) {
    const std::string& field = line.fields[column];
    const std::optional<double> time = ParseNumber(field);
    if (!time || !std::isfinite(*time)) line.Fail("'" + field + "' is no time; correct the line");
    if (!times.empty() && *time <= times.back()) line.Fail("the times must ascend; correct them");
    times.push_back(*time);
  }
  const double rate = UnitsPerSecond(GuessTimeUnit(times));
  for (double& time : times) time /= rate;
  return times;
}

void AdoptTimesOfFile(const std::string& directory, SequenceIndex* index) {
  const std::string path = FindTimesFile(directory);
  if (path.empty() || !index->has_assumed_times) return;
  std::string problem;
  try {
    const std::vector<double> times = ReadTimesFile(path);
    if (times.size() == index->entries.size()) return SetTimes(times, index);
    problem = path + FormatText(": has %zu times for %zu pairs of images", times.size(),
                                index->entries.size());
  } catch (const std::runtime_error& error) {
    problem = error.what();
  }
  index->warnings.push_back(problem + "; the file is not used");
}

void AdoptTimesOfTruth(const std::string& name, SequenceIndex* index) {
  if (!index->has_assumed_times || index->ground_truth.empty() || index->entries.empty()) return;
  OrderEntries(index);
  const std::vector<double> times = TimestampsOf(index->ground_truth, &TimedPose::timestamp);
  const size_t num_images = index->entries.size();
  if (times.size() != num_images) {
    index->warnings.push_back(
        name + FormatText(": has %zu poses for %zu images, whose times are assumed; if their rate "
                          "is wrong, so are the errors: write times.txt with a line for each image",
                          times.size(), num_images));
    return;
  }
  double largest = 0.0;
  for (const double difference : DifferencesOf(times, *index)) {
    largest = std::max(largest, std::abs(difference));
  }
  const bool ascend =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  if (largest <= kTimeRounding || !ascend) return;
  SetTimes(times, index);
  index->warnings.push_back(
      name + FormatText(": the images, which have no times of their own, get those of the poses, "
                        "%.3g per second, image by image",
                        1.0 / MedianInterval(times)));
}

void CheckTimesOfTruth(const std::string& name, SequenceIndex* index) {
  OrderEntries(index);
  const std::vector<double> times = TimestampsOf(index->ground_truth, &TimedPose::timestamp);
  if (times.size() != index->entries.size() || times.empty()) return;
  const std::vector<double> differences = DifferencesOf(times, *index);
  const auto [least, most] = std::minmax_element(differences.begin(), differences.end());
  if (*most - *least > kTimeRounding || std::abs(*most) <= kTimeRounding) return;
  index->warnings.push_back(
      name + FormatText(": has as many poses as there are images, but all their frame numbers are "
                        "%.0f %s; poses and images with the same number are compared",
                        std::abs(*most) * kDefaultFrameRate, *most > 0.0 ? "higher" : "lower"));
}

}  // namespace msc_vo
