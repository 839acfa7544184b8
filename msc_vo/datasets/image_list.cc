// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_list.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Parses the stamp of a row. Throws std::runtime_error naming file and line if the field is not a
// number.
double ParseStamp(const TextLine& line, size_t field) {
  const std::optional<double> stamp = ParseNumber(line.fields[field]);
  if (!stamp || !std::isfinite(*stamp)) {
    line.Fail("'" + line.fields[field] + "' is not a time stamp; correct or remove the line");
  }
  return *stamp;
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

std::string ResolvePath(const TextLine& line, size_t field) {
  return (fs::path(line.file).parent_path() / line.fields[field]).string();
}

bool NamesDepth(const std::string& path) {
  return Lowercase(path).find("depth") != std::string::npos;
}

bool HasSixteenBits(const std::string& path) {
  // Unreadable files are reported when their frame is decoded.
  return FileProblem(path, kMaxImageBytes).empty() && ReadImageFile(path).depth() == CV_16U;
}

// Tests whether the first image of the row is the depth image.
bool IsDepthFirst(const TextLine& line) {
  const bool first = NamesDepth(line.fields[1]);
  if (first != NamesDepth(line.fields[3])) return first;
  return HasSixteenBits(ResolvePath(line, 1)) && !HasSixteenBits(ResolvePath(line, 3));
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

std::vector<ListedImage> ReadImageList(const std::string& path,
                                       std::vector<std::string>* warnings) {
  std::vector<ListedImage> images;
  const std::vector<TextLine> lines = ReadTextLines(path);
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
  const auto earlier = [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; };
  const auto unordered = std::is_sorted_until(images.begin(), images.end(), earlier);
  if (unordered != images.end()) {
    warnings->push_back(unordered->origin +
                        ": the images are not listed in order of time; they were sorted");
  }
  std::stable_sort(images.begin(), images.end(), earlier);
  return images;
}

ImageLists ReadAssociations(const std::string& path, std::vector<std::string>* warnings) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": lists no image; expected 'time colour time depth' rows");
  }
  for (const TextLine& line : lines) CheckAssociation(line);
  CheckPrecision(lines, {0, 2}, warnings);
  const bool depth_first = IsDepthFirst(lines.front());
  const auto image = [](const TextLine& line, size_t field) {
    return ListedImage{ParseStamp(line, field), ResolvePath(line, field + 1), line.Where()};
  };
  ImageLists images;
  for (const TextLine& line : lines) {
    images.color.push_back(image(line, depth_first ? 2 : 0));
    images.depth.push_back(image(line, depth_first ? 0 : 2));
  }
  return images;
}

std::string FindAssociations(const std::string& directory) {
  for (const char* name :
       {"associations.txt", "association.txt", "associated.txt", "assoc.txt", "associate.txt"}) {
    std::string path = (fs::path(directory) / name).string();
    if (HasEntry(path)) return path;
  }
  return "";
}

}  // namespace msc_vo
