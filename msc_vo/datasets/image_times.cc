// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_times.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>

#include "msc_vo/datasets/image_name.h"
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

// The row of each entry in a file with one for each colour image, each depth image or each pair;
// none if it has another number of rows.
std::optional<std::vector<size_t>> RowsOf(size_t num_rows, const SequenceIndex& index) {
  std::vector<size_t> rows;
  for (const SequenceEntry& entry : index.entries) {
    if (num_rows == index.num_color && entry.color_position >= 0) {
      rows.push_back(static_cast<size_t>(entry.color_position));
    } else if (num_rows == index.num_depth && entry.depth_position >= 0) {
      rows.push_back(static_cast<size_t>(entry.depth_position));
    } else {
      rows.push_back(rows.size());
    }
  }
  const bool fits =
      std::all_of(rows.begin(), rows.end(), [&](size_t row) { return row < num_rows; });
  if (rows.empty() || !fits) return std::nullopt;
  if (num_rows != index.num_color && num_rows != index.num_depth && num_rows != rows.size()) {
    return std::nullopt;
  }
  return rows;
}

// The row of each image by its name, with or without folder and ending; none if one is not named.
std::optional<std::vector<size_t>> RowsByName(const ImageTimes& times,
                                              const std::vector<std::string>& images) {
  std::map<std::string, size_t> row_of_name;
  for (size_t row = 0; row < times.names.size(); ++row) {
    row_of_name[StemOf(times.names[row])] = row;
    row_of_name[times.names[row]] = row;  // a name without ending may have a point
  }
  std::vector<size_t> rows;
  for (const std::string& image : images) {
    const auto row = row_of_name.find(StemOf(image));
    if (row == row_of_name.end()) return std::nullopt;
    rows.push_back(row->second);
  }
  return rows;
}

// The row of each entry: that of its colour or depth image if the file names the images of a
// stream, or else by the number of rows.
std::optional<std::vector<size_t>> RowsOf(const ImageTimes& times, const SequenceIndex& index) {
  if (times.names.empty()) return RowsOf(times.seconds.size(), index);
  std::vector<std::string> color, depth;
  for (const SequenceEntry& entry : index.entries) {
    color.push_back(entry.color_path);
    depth.push_back(entry.depth_path);
  }
  const auto rows = RowsByName(times, color);
  return rows ? rows : RowsByName(times, depth);
}

std::vector<double> TimesOfRows(const ImageTimes& times, const std::vector<size_t>& rows) {
  std::vector<double> seconds;
  for (const size_t row : rows) seconds.push_back(times.seconds[row]);
  return seconds;
}

// "6 pairs of images (7 colour, 6 depth)"
std::string DescribeCounts(const SequenceIndex& index) {
  return FormatText("%zu pairs of images (%zu colour, %zu depth)", index.entries.size(),
                    index.num_color, index.num_depth);
}

// Sets the time of each entry to that of its row.
void SetTimes(const std::vector<double>& times, const std::vector<size_t>& rows,
              SequenceIndex* index) {
  for (size_t i = 0; i < rows.size(); ++i) index->entries[i].timestamp = times[rows[i]];
  index->has_assumed_times = false;
}

// Tests whether almost all poses within the time range of the images are at the time of an image.
bool AreAtTimesOfImages(const SequenceIndex& index) {
  constexpr double kAlmostAll = 0.9;  // some images have no partner
  std::vector<double> images = TimestampsOf(index.entries, &SequenceEntry::timestamp);
  std::sort(images.begin(), images.end());
  size_t num_within = 0, num_equal = 0;
  for (const TimedPose& pose : index.ground_truth) {
    const double time = pose.timestamp;
    if (time < images.front() - kTimeRounding || time > images.back() + kTimeRounding) continue;
    ++num_within;
    const auto next = std::lower_bound(images.begin(), images.end(), time - kTimeRounding);
    if (next != images.end() && *next <= time + kTimeRounding) ++num_equal;
  }
  return num_within > 1 &&
         static_cast<double>(num_equal) >= kAlmostAll * static_cast<double>(num_within);
}

// Seconds from each image to the time of its row.
std::vector<double> DifferencesOf(const std::vector<double>& times, const std::vector<size_t>& rows,
                                  const SequenceIndex& index) {
  std::vector<double> differences;
  for (size_t i = 0; i < rows.size(); ++i) {
    differences.push_back(times[rows[i]] - index.entries[i].timestamp);
  }
  return differences;
}

}  // namespace

std::string FindTimesFile(const std::string& directory) {
  return FirstEntry(directory, {"times.txt", "timestamps.txt"});
}

ImageTimes ReadTimesFile(const std::string& path) {
  std::vector<TextLine> lines = ReadTextLines(path);
  if (!lines.empty() && !lines.front().HasNumber()) lines.erase(lines.begin());  // a header
  const bool begin_with_name = !lines.empty() && lines.front().fields.size() > 1 &&
                               !ParseNumber(lines.front().fields.front());
  const size_t column = begin_with_name || AreNumbered(lines) ? 1 : 0;
  RestoreFractions(column, &lines);
  ImageTimes times;
  for (const TextLine& line : lines) {
    if (line.fields.size() <= column) line.Fail("has no time; correct the line");
    const std::string& field = line.fields[column];
    const std::optional<double> time = ParseNumber(field);
    if (!time || !std::isfinite(*time)) line.Fail("'" + field + "' is no time; correct the line");
    if (!times.seconds.empty() && *time <= times.seconds.back()) {
      line.Fail("the times must ascend; correct them");
    }
    times.seconds.push_back(*time);
    if (begin_with_name) times.names.push_back(line.fields.front());
  }
  const double rate = UnitsPerSecond(GuessTimeUnit(times.seconds));
  for (double& time : times.seconds) time /= rate;
  return times;
}

std::vector<double> TimesOfImages(const std::string& path, const std::vector<std::string>& images) {
  const ImageTimes times = ReadTimesFile(path);
  if (!times.names.empty()) {
    if (const auto rows = RowsByName(times, images)) return TimesOfRows(times, *rows);
    throw std::runtime_error(path + ": does not name all images of " +
                             ParentFolder(images.front()));
  }
  if (times.seconds.size() == images.size()) return times.seconds;
  throw std::runtime_error(
      path + FormatText(": has %zu times for %zu images", times.seconds.size(), images.size()));
}

void AdoptTimesOfFile(const std::string& path, SequenceIndex* index) {
  if (path.empty() || !index->has_assumed_times) return;
  std::string problem;
  try {
    const ImageTimes times = ReadTimesFile(path);
    const auto rows = RowsOf(times, *index);
    if (rows) return SetTimes(times.seconds, *rows, index);
    problem = path +
              FormatText(times.names.empty() ? ": has %zu times for "
                                             : ": names %zu images, but not all of ",
                         times.seconds.size()) +
              DescribeCounts(*index);
  } catch (const std::runtime_error& error) {
    problem = error.what();
  }
  index->warnings.push_back(problem + "; the file is not used");
}

void AdoptTimesOfTruth(const std::string& name, const std::vector<double>& times,
                       SequenceIndex* index) {
  if (!index->has_assumed_times || index->ground_truth.empty() || index->entries.empty()) return;
  OrderEntries(index);
  const auto rows = RowsOf(times.size(), *index);
  if (!rows) {
    if (AreAtTimesOfImages(*index)) return;
    index->ground_truth.clear();
    index->warnings.push_back(
        name + FormatText(": has %zu poses for ", times.size()) + DescribeCounts(*index) +
        ", whose times are not known; the ground truth is left out, because errors at assumed "
        "times would be wrong: write times.txt with a line for each colour image");
    return;
  }
  double largest = 0.0;
  for (const double difference : DifferencesOf(times, *rows, *index)) {
    largest = std::max(largest, std::abs(difference));
  }
  const bool ascend =
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
  if (largest <= kTimeRounding || !ascend) return;
  SetTimes(times, *rows, index);
  index->warnings.push_back(
      name + FormatText(": the images, which have no times of their own, get those of the poses, "
                        "%.3g per second, image by image",
                        1.0 / MedianInterval(times)));
}

void AssignPosesInOrder(const std::string& name, TrajectoryFile file, SequenceIndex* index) {
  const size_t num_rows = file.poses.size() + static_cast<size_t>(file.num_left_out);
  OrderEntries(index);
  const auto rows = RowsOf(num_rows, *index);
  if (!rows) {
    index->warnings.push_back(name +
                              FormatText(": has %zu poses without time stamps for ", num_rows) +
                              DescribeCounts(*index) +
                              "; the ground truth is left out: write "
                              "'time tx ty tz qx qy qz qw' rows");
    return;
  }
  std::map<size_t, double> times;  // of the rows
  for (size_t i = 0; i < rows->size(); ++i) times[(*rows)[i]] = index->entries[i].timestamp;
  for (TimedPose& pose : file.poses) {
    const auto time = times.find(static_cast<size_t>(pose.timestamp));
    if (time == times.end()) continue;  // an image without a partner
    pose.timestamp = time->second;
    index->ground_truth.push_back(pose);
  }
  index->warnings.push_back(name +
                            ": the poses have no time stamps; they are assigned to the "
                            "images in their order");
}

void CheckTimesOfTruth(const std::string& name, SequenceIndex* index) {
  OrderEntries(index);
  const std::vector<double> times = TimestampsOf(index->ground_truth, &TimedPose::timestamp);
  if (times.size() != index->entries.size() || times.empty()) return;
  std::vector<double> differences;
  for (size_t i = 0; i < times.size(); ++i) {
    differences.push_back(times[i] - index->entries[i].timestamp);
  }
  const auto [least, most] = std::minmax_element(differences.begin(), differences.end());
  if (*most - *least > kTimeRounding || std::abs(*most) <= kTimeRounding) return;
  index->warnings.push_back(
      name + FormatText(": has as many poses as there are images, but all their frame numbers are "
                        "%.0f %s; poses and images with the same number are compared",
                        std::abs(*most) * kDefaultFrameRate, *most > 0.0 ? "higher" : "lower"));
}

}  // namespace msc_vo
