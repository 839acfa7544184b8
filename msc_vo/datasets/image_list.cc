// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_list.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/image_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Stamp of a row. Throws std::runtime_error naming file and line if the field is no number.
double ParseStamp(const TextLine& line, size_t field) {
  const std::optional<double> stamp = ParseNumber(line.fields[field]);
  if (!stamp || !std::isfinite(*stamp)) {
    throw std::runtime_error(line.Where() + ": '" + line.fields[field] +
                             "' is not a time stamp; correct or remove the line");
  }
  return *stamp;
}

std::string Relative(const TextLine& line, size_t field) {
  return (fs::path(line.file).parent_path() / line.fields[field]).string();
}

bool NamesDepth(const std::string& path) {
  std::string lower = path;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.find("depth") != std::string::npos;
}

bool HasSixteenBits(const std::string& path) {
  // What cannot be read is reported with the frame that it belongs to.
  return FileProblem(path, kMaxImageBytes).empty() && ReadImageFile(path).depth() == CV_16U;
}

// Whether the second path of the row is the colour image.
bool IsDepthFirst(const TextLine& line) {
  const bool first = NamesDepth(line.fields[1]);
  if (first != NamesDepth(line.fields[3])) return first;
  return HasSixteenBits(Relative(line, 1)) && !HasSixteenBits(Relative(line, 3));
}

void AddPair(const ListedImage& color, const ListedImage& depth, SequenceIndex* index) {
  const bool same_row = color.origin == depth.origin;
  const double delay = depth.stamp - color.stamp;
  // The stamps of two clocks do not tell which image came first.
  const bool same_clock = std::abs(delay) <= kMaxPairDifference;
  index->entries.push_back({color.stamp, color.path, depth.path,
                            same_row ? color.origin : color.origin + " and " + depth.origin,
                            same_clock ? delay : 0.0});
}

// Warns if one list begins and ends later than the other, by the same time: a recording has ends
// that do not match, but they match equally badly at both ends only by chance.
void CheckOffset(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                 double max_difference, SequenceIndex* index) {
  if (color.size() < 2 || depth.size() < 2) return;
  const double at_begin = depth.front().stamp - color.front().stamp;
  const double at_end = depth.back().stamp - color.back().stamp;
  if (std::min(std::abs(at_begin), std::abs(at_end)) <= max_difference) return;
  if (std::abs(at_begin - at_end) > max_difference) return;
  const double offset = 0.5 * (at_begin + at_end);
  index->warnings.push_back(FormatText(
      "the stamps of the depth images begin and end %.3f s %s than those of the colour images; if "
      "the clock of the depth camera is off by that, %s it in the list of depth images",
      std::abs(offset), offset > 0.0 ? "later" : "earlier", offset > 0.0 ? "subtract" : "add"));
}

void CheckAssociation(const TextLine& line) {
  const size_t count = line.fields.size();
  if (count != 4) {
    std::string message = line.Where() + ": expected 4 fields 'time colour time depth', found " +
                          std::to_string(count);
    if (count >= 8) message += " (is this a list with ground-truth poses?)";
    throw std::runtime_error(message + "; correct the line, or remove the file to have rgb.txt " +
                             "and depth.txt paired by time");
  }
  ParseStamp(line, 0);
  ParseStamp(line, 2);
  for (const size_t field : {1, 3}) {
    if (!ParseNumber(line.fields[field])) continue;
    throw std::runtime_error(line.Where() + ": '" + line.fields[field] +
                             "' should be the path of an image; expected 'time colour time depth'");
  }
}

}  // namespace

std::vector<ListedImage> ReadImageList(const std::string& path) {
  std::vector<ListedImage> images;
  for (const TextLine& line : ReadTextLines(path)) {
    if (line.fields.size() != 2) {
      throw std::runtime_error(line.Where() + ": expected 2 fields 'time path', found " +
                               std::to_string(line.fields.size()) + "; correct the line");
    }
    images.push_back({ParseStamp(line, 0), Relative(line, 1), line.Where()});
  }
  if (images.empty())
    throw std::runtime_error(path + ": lists no image; expected 'time path' rows");
  std::stable_sort(images.begin(), images.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  return images;
}

void PairByTime(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                double max_difference, SequenceIndex* index) {
  struct Candidate {
    double difference;
    size_t color, depth;
  };
  std::vector<Candidate> candidates;
  size_t first = 0;
  for (size_t i = 0; i < color.size(); ++i) {
    while (first < depth.size() && depth[first].stamp < color[i].stamp - max_difference) ++first;
    for (size_t j = first; j < depth.size(); ++j) {
      if (depth[j].stamp > color[i].stamp + max_difference) break;
      candidates.push_back({std::abs(depth[j].stamp - color[i].stamp), i, j});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.difference < b.difference; });
  constexpr size_t kNone = static_cast<size_t>(-1);
  std::vector<size_t> depth_of_color(color.size(), kNone);
  std::vector<bool> depth_is_taken(depth.size(), false);
  for (const Candidate& candidate : candidates) {
    if (depth_of_color[candidate.color] != kNone || depth_is_taken[candidate.depth]) continue;
    depth_of_color[candidate.color] = candidate.depth;
    depth_is_taken[candidate.depth] = true;
  }
  size_t paired = 0;
  for (size_t i = 0; i < color.size(); ++i) {
    if (depth_of_color[i] == kNone) continue;
    ++paired;
    AddPair(color[i], depth[depth_of_color[i]], index);
  }
  if (paired < color.size()) {
    index->warnings.push_back(
        std::to_string(color.size() - paired) + " of " + std::to_string(color.size()) +
        " colour images have no depth image within " +
        std::to_string(static_cast<int>(1000.0 * max_difference)) + " ms and are left out");
  }
  CheckOffset(color, depth, max_difference, index);
}

Associations ReadAssociations(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": lists no image; expected 'time colour time depth' rows");
  }
  for (const TextLine& line : lines) CheckAssociation(line);
  const bool depth_first = IsDepthFirst(lines.front());
  const auto image = [](const TextLine& line, size_t field) {
    return ListedImage{ParseStamp(line, field), Relative(line, field + 1), line.Where()};
  };
  Associations pairs;
  for (const TextLine& line : lines) {
    pairs.color.push_back(image(line, depth_first ? 2 : 0));
    pairs.depth.push_back(image(line, depth_first ? 0 : 2));
  }
  return pairs;
}

void AddPairs(const Associations& pairs, SequenceIndex* index) {
  for (size_t i = 0; i < pairs.color.size(); ++i) AddPair(pairs.color[i], pairs.depth[i], index);
  CheckOffset(pairs.color, pairs.depth, kMaxPairDifference, index);
}

std::string FindAssociations(const std::string& directory) {
  for (const char* name :
       {"associations.txt", "association.txt", "associated.txt", "assoc.txt", "associate.txt"}) {
    const std::string path = (fs::path(directory) / name).string();
    if (HasEntry(path)) return path;
  }
  return "";
}

bool AreFrameNumbers(const std::vector<double>& stamps) {
  constexpr double kLargestStep = 60.0;
  for (size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i] != std::floor(stamps[i]) || std::abs(stamps[i]) > 1e8) return false;
    if (i > 0 && std::abs(stamps[i] - stamps[i - 1]) > kLargestStep) return false;
  }
  return stamps.size() > 1;
}

}  // namespace msc_vo
