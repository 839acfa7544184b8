// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_list.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// A part of a list with ascending stamps.
struct AscendingRun {
  size_t begin = 0;  // position of its first image in the list
  std::vector<double> stamps;
};

std::vector<AscendingRun> AscendingRuns(const std::vector<ListedImage>& images) {
  std::vector<AscendingRun> runs;
  std::set<std::pair<double, std::string>> known;
  for (size_t i = 0; i < images.size(); ++i) {
    const double stamp = images[i].stamp;
    if (!known.emplace(stamp, images[i].path).second) continue;  // a repeated row
    if (runs.empty() || stamp < runs.back().stamps.back()) runs.push_back({i, {}});
    runs.back().stamps.push_back(stamp);
  }
  return runs;
}

// Tests whether sorting would interleave two runs: each image of one between two of the other.
// Parts in another order, and a block of images that is listed late, change runs three times.
bool AreMixedBySorting(const AscendingRun& a, const AscendingRun& b) {
  constexpr int kMinChanges = 5;
  int num_changes = 0;
  bool in_a = a.stamps.front() <= b.stamps.front();
  size_t i = 0, j = 0;
  while (i < a.stamps.size() && j < b.stamps.size()) {
    const bool takes_a = a.stamps[i] <= b.stamps[j];
    if (takes_a != in_a) ++num_changes;
    in_a = takes_a;
    ++(takes_a ? i : j);
  }
  return num_changes >= kMinChanges;
}

// Parses the stamp of a row. Throws std::runtime_error naming file and line if the field is not a
// number.
double ParseStamp(const TextLine& line, size_t field) {
  const std::optional<double> stamp = ParseNumber(line.fields[field]);
  if (!stamp || !std::isfinite(*stamp)) {
    line.Fail("'" + line.fields[field] +
              "' is not a time stamp; correct or remove the line, or begin it with #");
  }
  return *stamp;
}

// Reads the lines of a list. Removes a header, such as "timestamp filename", and joins the fields
// of a quoted path with blanks.
std::vector<TextLine> ReadListLines(const std::string& path) {
  std::vector<TextLine> lines = ReadTextLines(path);
  if (!lines.empty() && Lowercase(lines.front().fields.front()).rfind("time", 0) == 0) {
    lines.erase(lines.begin());
  }
  for (TextLine& line : lines) {
    std::vector<std::string> fields;
    bool is_quoted = false;
    for (const std::string& field : line.fields) {
      if (is_quoted) {
        fields.back() += " " + field;
      } else {
        fields.push_back(field);
      }
      const std::string& text = fields.back();
      is_quoted = !text.empty() && text.front() == '"' && (text.size() == 1 || text.back() != '"');
    }
    line.fields = std::move(fields);
  }
  return lines;
}

// Warns if the stamps in one of the fields lost digits.
void CheckPrecision(const std::vector<TextLine>& lines, const std::vector<size_t>& fields,
                    std::vector<std::string>* warnings) {
  for (const size_t field : fields) {
    std::vector<std::string> stamps;
    for (const TextLine& line : lines) stamps.push_back(line.fields[field]);
    const std::string problem = DescribeLostDigits(stamps);
    if (problem.empty()) continue;
    warnings->push_back(lines.front().Where() + ": " + problem);
    return;
  }
}

// Corrects the stamps in one of the fields, with a warning, see RestoreFractions().
void CorrectFractions(size_t field, std::vector<TextLine>* lines,
                      std::vector<std::string>* warnings) {
  if (!RestoreFractions(field, lines)) return;
  warnings->push_back(lines->front().file +
                      ": the stamps have nanoseconds without leading zeros behind the point, "
                      "and are read as such");
}

// The path in a field, which may be quoted or that of another system.
std::string ResolvePath(const TextLine& line, size_t field) {
  std::string path = line.fields[field];
  if (path.size() > 2 && path.front() == '"' && path.back() == '"') {
    path = path.substr(1, path.size() - 2);
  }
  std::replace(path.begin(), path.end(), '\\', '/');
  return (fs::path(line.file).parent_path() / path).string();
}

bool NamesDepth(const std::string& path) {
  return Lowercase(path).find("depth") != std::string::npos;
}

// Tests whether the image of a row has the pixels of a depth image: one channel of more than 8
// bits. None if it cannot be read, which is reported when its frame is decoded.
std::optional<bool> HasDepthPixels(const TextLine& line, size_t field) {
  const std::string path = ResolvePath(line, field);
  if (!FileProblem(path, kMaxImageBytes).empty()) return std::nullopt;
  try {
    const cv::Mat image = ReadImageFile(path);
    if (image.empty()) return std::nullopt;
    return image.channels() == 1 && image.elemSize1() > 1;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

// Throws std::runtime_error if the clock was set back in the list. `images` are those of the stamps
// in a field of the lines.
void RequireOneClock(const std::vector<TextLine>& lines, size_t field,
                     const std::vector<ListedImage>& images) {
  const std::optional<size_t> step = FindClockStep(images);
  if (!step) return;
  std::vector<double> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  std::string distance;
  if (!AreFrameNumbers(stamps)) {
    const double rate = UnitsPerSecond(GuessTimeUnit(stamps, std::nullopt, kMaxImageInterval));
    const double expected = 2.0 * stamps[*step - 1] - stamps[*step - 2];
    distance = FormatText(" by about %.3f s", (expected - stamps[*step]) / rate);
  }
  lines[*step].Fail("the clock goes back" + distance + ", from " + lines[*step - 1].fields[field] +
                    " to " + lines[*step].fields[field] +
                    ", into a time that has images already; correct the stamps from this line on, "
                    "or sort the list by time if they are right");
}

void CheckAssociation(const TextLine& line) {
  const size_t count = line.fields.size();
  if (count != 4) {
    std::string problem =
        "expected 4 fields 'time colour time depth', found " + std::to_string(count);
    if (count >= 8) problem += " (is this a list with ground-truth poses?)";
    line.Fail(problem +
              "; correct the line, or remove the file to pair rgb.txt and depth.txt by time");
  }
  ParseStamp(line, 0);
  ParseStamp(line, 2);
  for (const size_t field : {1, 3}) {
    if (!ParseNumber(line.fields[field])) continue;
    line.Fail("'" + line.fields[field] +
              "' should be the path of an image; expected 'time colour time depth'");
  }
}

}  // namespace

std::optional<size_t> FindClockStep(const std::vector<ListedImage>& images) {
  // A clock is set back once or twice in a recording; lists with more descents have no order.
  constexpr size_t kMinImages = 10;
  constexpr size_t kMinImagesPerStep = 5;
  const std::vector<AscendingRun> runs = AscendingRuns(images);
  if (images.size() < kMinImages || kMinImagesPerStep * (runs.size() - 1) > images.size()) {
    return std::nullopt;
  }
  for (size_t i = 1; i < runs.size(); ++i) {
    if (AreMixedBySorting(runs[i - 1], runs[i])) return runs[i].begin;
  }
  return std::nullopt;
}

std::vector<ListedImage> ReadImageList(const std::string& path,
                                       std::vector<std::string>* warnings) {
  std::vector<ListedImage> images;
  std::vector<TextLine> lines = ReadListLines(path);
  CorrectFractions(0, &lines, warnings);
  for (const TextLine& line : lines) {
    if (line.fields.size() != 2) {
      line.Fail("expected 2 fields 'time path', found " + std::to_string(line.fields.size()) +
                "; correct the line");
    }
    images.push_back({ParseStamp(line, 0), ResolvePath(line, 1), line.Where()});
  }
  if (images.empty()) {
    throw std::runtime_error(path + ": lists no image; expected 'time path' rows");
  }
  CheckPrecision(lines, {0}, warnings);
  RequireOneClock(lines, 0, images);
  const auto earlier = [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; };
  const auto unordered = std::is_sorted_until(images.begin(), images.end(), earlier);
  if (unordered != images.end()) {
    warnings->push_back(unordered->origin +
                        ": the images are not listed in order of time; they were sorted");
  }
  std::stable_sort(images.begin(), images.end(), earlier);
  return images;
}

bool IsDepthFirst(const std::vector<TextLine>& lines) {
  constexpr size_t kMaxTries = 10;
  for (size_t i = 0; i < std::min(lines.size(), kMaxTries); ++i) {
    const std::optional<bool> first = HasDepthPixels(lines[i], 1);
    const std::optional<bool> second = HasDepthPixels(lines[i], 3);
    if (!first || !second) continue;
    if (*first != *second) return *first;
    break;
  }
  const TextLine& line = lines.front();
  const bool named_first = NamesDepth(line.fields[1]);
  if (named_first != NamesDepth(line.fields[3])) return named_first;
  const std::optional<bool> first = HasDepthPixels(line, 1);
  const std::optional<bool> second = HasDepthPixels(line, 3);
  return first.has_value() != second.has_value() && (first ? *first : !*second);
}

ImageLists ReadAssociations(const std::string& path, std::vector<std::string>* warnings) {
  std::vector<TextLine> lines = ReadListLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": lists no image; expected 'time colour time depth' rows");
  }
  for (const TextLine& line : lines) CheckAssociation(line);
  for (const size_t field : {0, 2}) CorrectFractions(field, &lines, warnings);
  CheckPrecision(lines, {0, 2}, warnings);
  const bool depth_first = IsDepthFirst(lines);
  const auto image = [](const TextLine& line, size_t field) {
    return ListedImage{ParseStamp(line, field), ResolvePath(line, field + 1), line.Where()};
  };
  ImageLists images;
  for (const TextLine& line : lines) {
    images.color.push_back(image(line, depth_first ? 2 : 0));
    images.depth.push_back(image(line, depth_first ? 0 : 2));
  }
  RequireOneClock(lines, depth_first ? 2 : 0, images.color);
  return images;
}

std::string FindAssociations(const std::string& directory) {
  return FirstEntry(directory, {"associations.txt", "association.txt", "associated.txt",
                                "assoc.txt", "associate.txt"});
}

}  // namespace msc_vo
