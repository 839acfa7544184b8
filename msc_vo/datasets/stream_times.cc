// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/stream_times.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <regex>
#include <stdexcept>

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/image_times.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// The text files of a folder whose names match, in alphabetical order.
std::vector<std::string> FilesNamed(const std::string& folder, const std::regex& pattern) {
  std::vector<std::string> files;
  if (!FolderProblem(folder).empty()) return files;
  for (const std::string& path : ListFolder(folder)) {
    const std::string name = Lowercase(fs::path(path).filename().string());
    const bool matches = std::regex_match(name, pattern);
    if (matches && FileProblem(path).empty()) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The images at the times of the file; none, with a warning, if it does not fit.
std::optional<std::vector<ListedImage>> TimedImages(const std::string& file,
                                                    const std::vector<std::string>& paths,
                                                    SequenceIndex* index) {
  std::vector<ListedImage> images;
  try {
    const std::vector<double> times = TimesOfImages(file, paths);
    for (size_t i = 0; i < paths.size(); ++i) images.push_back({times[i], paths[i], paths[i]});
  } catch (const std::runtime_error& error) {
    index->warnings.push_back(error.what() + std::string("; the file is not used"));
    return std::nullopt;
  }
  std::sort(images.begin(), images.end(),
            [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  return images;
}

// The number of lines without a header.
size_t CountRows(const std::vector<TextLine>& lines) {
  return lines.empty() || lines.front().HasNumber() ? lines.size() : lines.size() - 1;
}

}  // namespace

std::string FindStreamTimes(const std::string& folder) {
  static const std::regex kInside(".*(time|stamp).*\\.(txt|csv)");
  static const std::regex kBeside("[_. -]?(times?|(time[_-]?)?stamps?)\\.(txt|csv)");
  const std::vector<std::string> inside = FilesNamed(folder, kInside);
  if (inside.size() == 1) return inside.front();
  const std::string parent = fs::path(folder).parent_path().string();
  const std::string stream = Lowercase(fs::path(folder).filename().string());
  for (const std::string& path : FilesNamed(parent, kInside)) {
    const std::string name = Lowercase(fs::path(path).filename().string());
    if (name.rfind(stream, 0) == 0 && std::regex_match(name.substr(stream.size()), kBeside)) {
      return path;
    }
  }
  return "";
}

bool PairedByStreamTimes(const std::string& color_file, const std::vector<std::string>& color,
                         const std::string& depth_file, const std::vector<std::string>& depth,
                         SequenceIndex* index) {
  if (color_file.empty() || depth_file.empty()) return false;
  const auto timed_color = TimedImages(color_file, color, index);
  const auto timed_depth = TimedImages(depth_file, depth, index);
  if (!timed_color || !timed_depth) return false;
  const ImageLists images = {*timed_color, *timed_depth};
  PairByTime(images, MaxPairDifference(images), index);
  return true;
}

void WarnOfUnusedTimes(const std::string& folder, const std::vector<std::string>& used,
                       SequenceIndex* index) {
  constexpr size_t kMaxColumns = 4;  // poses have more
  static const std::regex kPattern(".*(time|stamp|assoc|frames|images|list|data).*\\.(txt|csv)");
  for (const std::string& path : FilesNamed(folder, kPattern)) {
    if (std::find(used.begin(), used.end(), path) != used.end()) continue;
    std::vector<TextLine> lines;
    try {
      lines = ReadTextLines(path);
    } catch (const std::runtime_error&) {  // another kind of file
      continue;
    }
    const size_t num_rows = CountRows(lines);
    if (num_rows == 0 || lines.back().fields.size() > kMaxColumns) continue;
    if (num_rows != index->num_color && num_rows != index->num_depth) continue;
    index->warnings.push_back(
        path + FormatText(": has a line for each of %zu images, but is not used; if it gives their "
                          "times, write these to times.txt, or to rgb/timestamps.txt and "
                          "depth/timestamps.txt if the streams differ",
                          num_rows));
  }
}

}  // namespace msc_vo
