// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/name_pairing.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/image_name.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/named_images.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

std::vector<ListedImage> StampedImages(const NamedImages& images) {
  std::vector<ListedImage> listed;
  for (size_t i = 0; i < images.paths.size(); ++i) {
    listed.push_back({images.times[i], images.paths[i], images.paths[i]});
  }
  std::stable_sort(listed.begin(), listed.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  return listed;
}

// Pairs the images by time if the time ranges of both streams overlap; returns whether they do.
bool PairedByTime(const NamedImages& color, const NamedImages& depth, SequenceIndex* index) {
  if (color.times.empty() || depth.times.empty()) return false;
  const ImageLists images = {StampedImages(color), StampedImages(depth)};
  const double max_difference = MaxPairDifference(images);
  const double common = std::min(images.color.back().stamp, images.depth.back().stamp) -
                        std::max(images.color.front().stamp, images.depth.front().stamp);
  if (common < -max_difference) return false;
  index->stamp_unit = color.unit;
  PairByTime(images, max_difference, index);
  return true;
}

// Warns if the depth images have the numbers of the colour images plus a constant: the same image
// may have different numbers in both streams.
void CheckNumberOffset(const NamedImages& color, const NamedImages& depth, SequenceIndex* index) {
  const int64_t offset = depth.numbers.front() - color.numbers.front();
  if (offset == 0 || depth.numbers.back() - color.numbers.back() != offset) return;
  index->warnings.push_back(
      FormatText("the frame numbers of the depth images begin and end %lld %s than those of the "
                 "colour images; "
                 "images with the same number are paired; if that is wrong, write associations.txt",
                 static_cast<long long>(std::abs(offset)), offset > 0 ? "higher" : "lower"));
}

// Warns if both streams count without a gap from the same number, to different ends: the partners
// of missing images would have other numbers. A recording may end between two images of a pair.
void CheckCounters(const NamedImages& color, const NamedImages& depth, SequenceIndex* index) {
  const auto range_of = [](const NamedImages& images) {
    const auto [first, last] = std::minmax_element(images.numbers.begin(), images.numbers.end());
    const bool has_gap = *last - *first + 1 != static_cast<int64_t>(images.numbers.size());
    return std::tuple(*first, *last, has_gap);
  };
  const auto [color_first, color_last, color_gap] = range_of(color);
  const auto [depth_first, depth_last, depth_gap] = range_of(depth);
  if (color_gap || depth_gap || color_first != depth_first ||
      std::abs(color_last - depth_last) <= 1) {
    return;
  }
  index->warnings.push_back(FormatText(
      "%zu colour images and %zu depth images are numbered without a gap; images with the same "
      "number are paired, which is wrong if each stream counts its own images: write "
      "associations.txt then",
      color.numbers.size(), depth.numbers.size()));
}

// Adds the pair of two images, at the time that either name holds.
void AddPair(const NamedImages& color, size_t i, const NamedImages& depth, size_t j,
             SequenceIndex* index) {
  double stamp = static_cast<double>(color.numbers[i]) / kDefaultFrameRate;
  if (depth.certainty == NamedTimes::kCertain) stamp = depth.times[j];
  if (color.certainty == NamedTimes::kCertain) stamp = color.times[i];
  index->entries.push_back({stamp, color.paths[i], depth.paths[j], ""});
}

// Pairs the images with the same number; returns whether there are any.
bool PairedByNumber(const NamedImages& color, const NamedImages& depth, SequenceIndex* index) {
  std::map<int64_t, size_t> depth_of_number;
  for (size_t i = 0; i < depth.numbers.size(); ++i) depth_of_number.emplace(depth.numbers[i], i);
  for (size_t i = 0; i < color.numbers.size(); ++i) {
    const auto found = depth_of_number.find(color.numbers[i]);
    if (found != depth_of_number.end()) AddPair(color, i, depth, found->second, index);
  }
  const size_t num_pairs = index->entries.size();
  if (num_pairs == 0) return false;
  index->has_assumed_times =
      color.certainty != NamedTimes::kCertain && depth.certainty != NamedTimes::kCertain;
  CheckCounters(color, depth, index);
  const size_t num_unpaired = color.paths.size() - num_pairs + depth.paths.size() - num_pairs;
  if (num_unpaired > 0) {
    index->warnings.push_back(
        std::to_string(num_unpaired) +
        " images have no partner with the same frame number and are left out");
  }
  CheckNumberOffset(color, depth, index);
  if (color.certainty == NamedTimes::kPossible && depth.certainty == NamedTimes::kPossible) {
    index->warnings.push_back(FormatText(
        "the names count in steps of %lld; the numbers are read as frame numbers at %.0f per "
        "second; if they are times, write rgb.txt and depth.txt with 'time path' rows",
        static_cast<long long>(color.numbers[1] - color.numbers[0]), kDefaultFrameRate));
  }
  return true;
}

// Whether the numbers of both streams differ by a constant that leaves them no number in common.
bool HaveSeparateNumbers(const NamedImages& color, const NamedImages& depth) {
  const auto [first, last] = std::minmax_element(color.numbers.begin(), color.numbers.end());
  const auto [begin, end] = std::minmax_element(depth.numbers.begin(), depth.numbers.end());
  if (*first <= *end && *begin <= *last) return false;
  for (size_t i = 0; i < color.numbers.size(); ++i) {
    if (depth.numbers[i] - color.numbers[i] != *begin - *first) return false;
  }
  return true;
}

[[noreturn]] void FailPairing(const NamedImages& color, const NamedImages& depth) {
  const auto folder = [](const NamedImages& images) {
    return std::filesystem::path(images.paths.front()).parent_path().string();
  };
  throw std::runtime_error(FormatText(
      "%s: %zu colour images, but %zu depth images in %s, and their names do not tell the pairs: "
      "those of the colour images hold %s, those of the depth images %s; write associations.txt "
      "with 'time colour time depth' rows",
      folder(color).c_str(), color.paths.size(), depth.paths.size(), folder(depth).c_str(),
      color.description.c_str(), depth.description.c_str()));
}

std::map<std::string, std::string> PathsByStem(const std::vector<std::string>& paths) {
  std::map<std::string, std::string> path_of_stem;
  for (const std::string& path : paths) path_of_stem.emplace(StemOf(path), path);
  return path_of_stem;
}

// Tests whether names that differ in pattern from most, and whose images were left out, belong to
// pairs of equal names: then the names are no numbers.
bool LeavesOutPairs(const std::vector<std::string>& color_paths,
                    const std::vector<std::string>& depth_paths, const NamedImages& color) {
  constexpr double kMaxRatio = 0.1;  // of files of another kind among the images
  const auto depth_of_stem = PathsByStem(depth_paths), kept = PathsByStem(color.paths);
  const auto num_left_out =
      std::count_if(color_paths.begin(), color_paths.end(), [&](const std::string& path) {
        return kept.count(StemOf(path)) == 0 && depth_of_stem.count(StemOf(path)) > 0;
      });
  return static_cast<double>(num_left_out) > kMaxRatio * static_cast<double>(color_paths.size());
}

// Pairs images whose names are equal, in the order of these at kDefaultFrameRate, if most images of
// a stream have such a partner; returns whether they do.
bool PairedByStem(const std::vector<std::string>& color_paths,
                  const std::vector<std::string>& depth_paths, SequenceIndex* index) {
  std::vector<std::string> stems;
  const auto color_of_stem = PathsByStem(color_paths), depth_of_stem = PathsByStem(depth_paths);
  for (const auto& [stem, path] : color_of_stem) stems.push_back(stem);
  for (const auto& [stem, path] : depth_of_stem) {
    if (color_of_stem.count(stem) == 0) stems.push_back(stem);
  }
  const size_t num_pairs = color_of_stem.size() + depth_of_stem.size() - stems.size();
  if (2 * num_pairs <= std::min(color_paths.size(), depth_paths.size())) return false;
  SortNames(&stems);
  for (size_t i = 0; i < stems.size(); ++i) {
    const auto color = color_of_stem.find(stems[i]), depth = depth_of_stem.find(stems[i]);
    if (color == color_of_stem.end() || depth == depth_of_stem.end()) continue;
    index->entries.push_back({i / kDefaultFrameRate, color->second, depth->second, ""});
  }
  index->has_assumed_times = true;
  const size_t num_unpaired = color_paths.size() + depth_paths.size() - 2 * num_pairs;
  index->warnings.push_back(
      FormatText(
          "images of the same name are paired, in the order of the names, at %.0f per second",
          kDefaultFrameRate) +
      (num_unpaired == 0
           ? ""
           : FormatText("; %zu images without a partner are left out", num_unpaired)));
  return true;
}

// Pairs images at the same position of both lists, at kDefaultFrameRate.
void PairByPosition(const NamedImages& color, const NamedImages& depth, SequenceIndex* index) {
  const bool have_times =
      color.certainty == NamedTimes::kCertain || depth.certainty == NamedTimes::kCertain;
  const bool have_numbers = !color.numbers.empty() && !depth.numbers.empty();
  if (have_times || color.paths.size() != depth.paths.size() ||
      (have_numbers && !HaveSeparateNumbers(color, depth))) {
    FailPairing(color, depth);
  }
  for (size_t i = 0; i < color.paths.size(); ++i) {
    index->entries.push_back({i / kDefaultFrameRate, color.paths[i], depth.paths[i], ""});
  }
  index->has_assumed_times = true;
  index->warnings.push_back(FormatText(
      "the images are paired by the order of their names, at %.0f per second, because the names of "
      "the colour images hold %s, those of the depth images %s",
      kDefaultFrameRate, color.description.c_str(), depth.description.c_str()));
}

std::optional<TimeRange> RangeOfTimes(const NamedImages& images) {
  if (images.times.empty()) return std::nullopt;
  return RangeOf(images.times, images.unit);
}

// Pairs the images by the times or the numbers in their names. The paths are those of all images of
// the streams.
void PairByContents(const NamedImages& color, const NamedImages& depth,
                    const std::vector<std::string>& color_paths,
                    const std::vector<std::string>& depth_paths, SequenceIndex* index) {
  for (const std::string& warning : color.warnings) {
    index->warnings.push_back("colour images: " + warning);
  }
  for (const std::string& warning : depth.warnings) {
    index->warnings.push_back("depth images: " + warning);
  }
  const bool may_be_numbers =
      color.certainty != NamedTimes::kCertain && depth.certainty != NamedTimes::kCertain;
  if (!may_be_numbers && PairedByTime(color, depth, index)) return;
  if (PairedByNumber(color, depth, index)) return;
  if (may_be_numbers && PairedByTime(color, depth, index)) return;
  const bool hold_nothing = color.times.empty() && color.numbers.empty();
  if (hold_nothing && PairedByStem(color_paths, depth_paths, index)) return;
  PairByPosition(color, depth, index);
}

void SetPositions(const std::vector<std::string>& color_paths,
                  const std::vector<std::string>& depth_paths, SequenceIndex* index) {
  std::map<std::string, int> positions;
  for (const std::vector<std::string>* paths : {&color_paths, &depth_paths}) {
    for (size_t i = 0; i < paths->size(); ++i) positions[(*paths)[i]] = static_cast<int>(i);
  }
  for (SequenceEntry& entry : index->entries) {
    entry.color_position = positions.at(entry.color_path);
    entry.depth_position = positions.at(entry.depth_path);
  }
  index->num_color = color_paths.size();
  index->num_depth = depth_paths.size();
}

}  // namespace

void PairByName(const std::vector<std::string>& color_paths,
                const std::vector<std::string>& depth_paths, SequenceIndex* index) {
  if (color_paths.empty() || depth_paths.empty()) return;
  const NamedImages color = ReadImageNames(color_paths);
  const NamedImages depth = ReadImageNames(depth_paths, RangeOfTimes(color));
  if (!LeavesOutPairs(color_paths, depth_paths, color) ||
      !PairedByStem(color_paths, depth_paths, index)) {
    PairByContents(color, depth, color_paths, depth_paths, index);
  }
  index->num_listed = std::min(color_paths.size(), depth_paths.size());
  SetPositions(color_paths, depth_paths, index);
}

}  // namespace msc_vo
