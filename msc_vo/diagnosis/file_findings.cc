// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <exception>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMaxReports = 5;
// A few equal images are those of a camera that stands still, or of a dropped frame that the
// recorder repeated.
constexpr double kMaxRepeatedRatio = 0.05;

void AddUnreadableFiles(const SequenceIndex& index, Findings* findings) {
  int num_unreadable = 0;
  for (const SequenceEntry& entry : index.entries) {
    for (const std::string& path : {entry.color_path, entry.depth_path}) {
      const std::string problem = FileProblem(path, kMaxImageBytes);
      if (problem.empty()) continue;
      if (++num_unreadable > kMaxReports) continue;
      findings->push_back(Error(
          "files.readable",
          path + " " + problem + (entry.origin.empty() ? "" : " (named in " + entry.origin + ")"),
          "restore the file or remove its line"));
    }
  }
  if (num_unreadable == 0) {
    findings->push_back(Good("files.readable", "all image files exist"));
  } else if (num_unreadable > kMaxReports) {
    findings->push_back(
        Error("files.readable",
              FormatText("%d image files in total are missing or unreadable", num_unreadable),
              "copy the sequence again", Measurement{1.0 * num_unreadable, "files"}));
  }
}

bool AreEqual(const std::string& a, const std::string& b) {
  std::error_code error_a, error_b;
  const auto size_a = std::filesystem::file_size(a, error_a);
  const auto size_b = std::filesystem::file_size(b, error_b);
  if (error_a || error_b || size_a != size_b) return false;
  if (std::filesystem::equivalent(a, b, error_a)) return true;
  try {
    return ReadFile(a, kMaxImageBytes) == ReadFile(b, kMaxImageBytes);
  } catch (const std::exception&) {
    return false;  // reported by AddUnreadableFiles()
  }
}

// Whether an image has no contrast, or a depth image a single value. False if it cannot be decoded.
bool IsUniformImage(const std::string& path, bool is_depth) {
  constexpr double kRounding = 1e-4;  // more than that of the deviation, relative
  try {
    const cv::Mat image = DecodeImage(ReadFile(path, kMaxImageBytes), cv::IMREAD_UNCHANGED);
    if (image.empty()) return false;
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    const double limit = is_depth ? kRounding * mean[0] : kMinImageContrast;
    return cv::norm(deviation, cv::NORM_INF) <= limit;
  } catch (const std::exception&) {
    return false;  // reported by the check of the decoded images
  }
}

// Number of images that equal the one before. Black images and those without any depth are equal in
// a stream that goes on, and are reported by other checks.
int CountRepetitions(const SequenceIndex& index, std::string SequenceEntry::*path) {
  const bool is_depth = path == &SequenceEntry::depth_path;
  int count = 0;
  bool is_run = false;  // of equal images
  bool is_uniform = false;
  for (size_t i = 1; i < index.entries.size(); ++i) {
    const bool was_run = is_run;
    is_run = AreEqual(index.entries[i - 1].*path, index.entries[i].*path);
    if (!is_run) continue;
    if (!was_run) is_uniform = IsUniformImage(index.entries[i].*path, is_depth);
    if (!is_uniform) ++count;
  }
  return count;
}

void AddRepetitions(const SequenceIndex& index, const std::string& kind,
                    std::string SequenceEntry::*path, Findings* findings) {
  const int num_pairs = static_cast<int>(index.entries.size()) - 1;
  if (num_pairs < 1) return;
  const int count = CountRepetitions(index, path);
  const double ratio = static_cast<double>(count) / num_pairs;
  const std::string text = FormatText("%d of %d %s images equal the image before, byte for byte",
                                      count, num_pairs + 1, kind.c_str());
  const std::string check = kind == "depth" ? "files.frozen_depth" : "files.frozen_color";
  const Measurement measurement{ratio, "ratio"};
  if (ratio <= kMaxRepeatedRatio) {
    if (count > 0) findings->push_back(Good(check, text, measurement));
    return;
  }
  findings->push_back(Warning(check, text,
                              "the stream was frozen or frames were repeated: remove the repeated "
                              "frames from the lists, or record again",
                              measurement));
}

}  // namespace

void AddFileFindings(const SequenceIndex& index, Findings* findings) {
  if (index.container) return;  // the images are in one file, which has been opened
  AddUnreadableFiles(index, findings);
  AddRepetitions(index, "colour", &SequenceEntry::color_path, findings);
  AddRepetitions(index, "depth", &SequenceEntry::depth_path, findings);
}

}  // namespace msc_vo
