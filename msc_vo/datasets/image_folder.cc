// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_folder.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/image_file.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsImage(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr const char* kExtensions[] = {".png", ".jpg", ".jpeg", ".pgm",
                                         ".ppm", ".bmp", ".tiff", ".tif"};
  return std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
         std::end(kExtensions);
}

// One past the run of digits that starts at `begin`.
size_t EndOfDigits(const std::string& text, size_t begin) {
  while (begin < text.size() && IsDigit(text[begin])) ++begin;
  return begin;
}

// The run of digits without leading zeros, so that longer means larger.
std::string Significant(const std::string& text, size_t begin, size_t end) {
  while (begin + 1 < end && text[begin] == '0') ++begin;
  return text.substr(begin, end - begin);
}

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool EndsWith(const std::string& text, const std::string& suffix) {
  return text.size() >= suffix.size() &&
         text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

}  // namespace

bool NaturalLess(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const size_t end_i = EndOfDigits(a, i);
      const size_t end_j = EndOfDigits(b, j);
      const std::string number_a = Significant(a, i, end_i);
      const std::string number_b = Significant(b, j, end_j);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      i = end_i;
      j = end_j;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  const size_t left_a = a.size() - i;
  const size_t left_b = b.size() - j;
  return left_a != left_b ? left_a < left_b : a < b;  // "01" and "1": any fixed order
}

std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix,
                                    const std::string& suffix) {
  std::vector<std::string> paths;
  if (!IsFolder(folder)) return paths;
  for (const std::string& path : ListFolder(folder)) {
    const std::string stem = fs::path(path).stem().string();
    if (stem.empty() || stem[0] == '.' || !IsImage(path) || IsFolder(path)) continue;
    if (StartsWith(stem, prefix) && EndsWith(stem, suffix)) paths.push_back(path);
  }
  std::sort(paths.begin(), paths.end(), NaturalLess);
  return paths;
}

std::optional<int64_t> FrameNumber(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  size_t end = stem.size();
  while (end > 0 && !IsDigit(stem[end - 1])) --end;
  size_t begin = end;
  while (begin > 0 && IsDigit(stem[begin - 1])) --begin;
  constexpr size_t kMaxDigits = 18;  // fits int64_t
  if (begin == end || end - begin > kMaxDigits) return std::nullopt;
  return std::stoll(stem.substr(begin, end - begin));
}

std::optional<double> StampFromName(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  constexpr size_t kNanosecondDigits = 16;  // more than any frame number, less than any date in ns
  const std::optional<double> value = ParseNumber(stem);
  if (value && std::isfinite(*value)) {
    if (stem.find('.') != std::string::npos) return value;
    if (const auto unit = UnitOfDate(*value)) return *value / UnitsPerSecond(*unit);
    if (stem.size() >= kNanosecondDigits) return 1e-9 * *value;
  }
  const std::optional<int64_t> number = FrameNumber(path);
  if (!number) return std::nullopt;
  return static_cast<double>(*number) / kDefaultFrameRate;
}

void PairByFrameNumber(const std::vector<std::string>& color_paths,
                       const std::vector<std::string>& depth_paths, SequenceIndex* index) {
  std::map<int64_t, std::string> depth_of_number;
  for (const std::string& path : depth_paths) {
    if (const auto number = FrameNumber(path)) depth_of_number.emplace(*number, path);
  }
  size_t paired = 0;
  for (const std::string& path : color_paths) {
    const auto number = FrameNumber(path);
    const auto depth = number ? depth_of_number.find(*number) : depth_of_number.end();
    if (depth == depth_of_number.end()) continue;
    ++paired;
    index->entries.push_back(
        {static_cast<double>(*number) / kDefaultFrameRate, path, depth->second, ""});
  }
  const size_t alone = color_paths.size() - paired + depth_paths.size() - paired;
  if (alone > 0) {
    index->warnings.push_back(std::to_string(alone) +
                              " images have no partner with their frame number and are left out");
  }
}

ImageSize ReadImageSize(const std::string& path) {
  const cv::Mat image = ReadImageFile(path);
  if (image.empty()) {
    throw std::runtime_error(path + ": cannot be read as an image; restore the file");
  }
  return {image.cols, image.rows};
}

}  // namespace msc_vo
