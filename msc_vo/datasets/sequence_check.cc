// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "msc_vo/evaluation/association.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMaxReportsOfOneKind = 5;

std::string Rounded(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), "%.*f", decimals, value);
  return buffer;
}

// Value below which the share p of the samples lies; reorders them.
template <typename T>
T Quantile(double p, std::vector<T>* samples) {
  const auto nth =
      samples->begin() + static_cast<int>(p * static_cast<double>(samples->size() - 1));
  std::nth_element(samples->begin(), nth, samples->end());
  return *nth;
}

class SequenceChecker {
 public:
  SequenceChecker(const RgbdDecoder& decoder, const SequenceCheckOptions& options)
      : decoder_(decoder), index_(decoder.index()), options_(options) {}

  std::vector<Finding> Check() {
    for (const std::string& warning : index_.warnings) Add(Severity::kWarning, warning);
    CheckFiles();
    CheckStamps();
    CheckDelays();
    CheckCamera();
    CheckImages();
    CheckGroundTruth();
    return std::move(findings_);
  }

 private:
  void Add(Severity severity, const std::string& text) { findings_.push_back({severity, text}); }

  void CheckFiles() {
    int missing = 0;
    for (const SequenceEntry& entry : index_.entries) {
      for (const std::string& path : {entry.color_path, entry.depth_path}) {
        const std::string problem = FileProblem(path, kMaxImageBytes);
        if (problem.empty()) continue;
        if (++missing > kMaxReportsOfOneKind) continue;
        Add(Severity::kError, path + " " + problem +
                                  (entry.origin.empty() ? "" : " (named in " + entry.origin + ")"));
      }
    }
    if (missing == 0) Add(Severity::kGood, "all image files are there");
    if (missing > kMaxReportsOfOneKind) {
      Add(Severity::kError,
          std::to_string(missing) + " image files are missing or no files in total");
    }
  }

  void CheckStamps() {
    const std::vector<SequenceEntry>& entries = index_.entries;
    const double duration = entries.back().timestamp - entries.front().timestamp;
    std::vector<double> intervals;
    for (size_t i = 1; i < entries.size(); ++i) {
      intervals.push_back(entries[i].timestamp - entries[i - 1].timestamp);
    }
    if (intervals.empty()) {
      Add(Severity::kWarning, "one image only");
      return;
    }
    const double median = Quantile(0.5, &intervals);
    Add(Severity::kGood, std::to_string(entries.size()) + " image pairs in " +
                             Rounded(duration, 1) + " s, " + Rounded(1.0 / median, 1) +
                             " per second");
    constexpr double kMinInterval = 0.001, kMaxInterval = 5.0;  // seconds; no RGB-D camera's
    if (median < kMinInterval || median > kMaxInterval) {
      Add(Severity::kWarning, FormatText("%g s from image to image are unusual: are the stamps in "
                                         "seconds?",
                                         median));
    }
    // Constant velocity survives one or two dropped frames, not more.
    constexpr double kMaxGap = 3.5;  // in median intervals
    const auto gaps = std::count_if(intervals.begin(), intervals.end(),
                                    [&](double interval) { return interval > kMaxGap * median; });
    if (gaps > 0) {
      const double longest = *std::max_element(intervals.begin(), intervals.end());
      Add(Severity::kWarning, std::to_string(gaps) + " gaps of three frames or more, the longest " +
                                  Rounded(longest, 3) + " s");
    }
  }

  void CheckDelays() {
    const auto [first, last] = std::minmax_element(
        index_.entries.begin(), index_.entries.end(),
        [](const auto& a, const auto& b) { return a.depth_delay < b.depth_delay; });
    if (first->depth_delay == 0.0 && last->depth_delay == 0.0) return;
    Add(Severity::kGood, "depth images are " + Rounded(1e3 * first->depth_delay, 1) + " to " +
                             Rounded(1e3 * last->depth_delay, 1) +
                             " ms later than their colour images; replay makes up for how the "
                             "camera moves in that time");
  }

  void CheckCamera() {
    const Calibration& calibration = decoder_.calibration();
    const PinholeCamera& camera = calibration.camera;
    Add(Severity::kGood, "camera from " + calibration.origin + ": fx " + Rounded(camera.fx, 3) +
                             ", fy " + Rounded(camera.fy, 3) + ", cx " + Rounded(camera.cx, 3) +
                             ", cy " + Rounded(camera.cy, 3) + ", " + std::to_string(camera.width) +
                             "x" + std::to_string(camera.height) + ", " +
                             Rounded(calibration.depth_scale, 1) + " depth units per metre" +
                             (calibration.distortion.IsZero() ? "" : ", with lens distortion"));
    if (camera.fy < 0.0 && index_.format != "icl-nuim") {
      Add(Severity::kWarning, "fy is negative: right only if the images are mirrored (ICL-NUIM)");
    }
    if (camera.fy > 0.0 && index_.format == "icl-nuim") {
      Add(Severity::kWarning,
          "fy is positive, but original ICL-NUIM images are mirrored: with "
          "fy = -480 the trajectory agrees with its ground truth");
    }
    if (std::abs(std::abs(camera.fx / camera.fy) - 1.0) > 0.1) {
      Add(Severity::kWarning,
          "fx and fy differ by more than 10 %: pixels are hardly ever that "
          "far from square");
    }
    const bool centred = std::abs(camera.cx / camera.width - 0.5) < 0.2 &&
                         std::abs(camera.cy / camera.height - 0.5) < 0.2;
    if (!centred) {
      Add(Severity::kWarning,
          "cx, cy lie far from the middle of the image: is the calibration "
          "that of another image size?");
    }
  }

  void CheckImages() {
    const int count = std::min(std::max(options_.max_images, 1), decoder_.size());
    std::vector<float> depths;
    size_t num_pixels = 0;
    int failed = 0;
    for (int k = 0; k < count; ++k) {
      const int i =
          count == 1
              ? 0
              : static_cast<int>(static_cast<int64_t>(k) * (decoder_.size() - 1) / (count - 1));
      try {
        const RgbdImage image = decoder_.Decode(i);
        // Every 16th pixel is plenty for a distribution.
        for (int p = 0; p < static_cast<int>(image.depth.total()); p += 16, ++num_pixels) {
          const float depth = image.depth.at<float>(p / image.depth.cols, p % image.depth.cols);
          if (depth > 0.0f) depths.push_back(depth);
        }
      } catch (const std::exception& error) {
        if (++failed <= kMaxReportsOfOneKind) Add(Severity::kError, error.what());
      }
    }
    if (failed > kMaxReportsOfOneKind) {
      Add(Severity::kError,
          std::to_string(failed) + " of " + std::to_string(count) + " images cannot be used");
    }
    if (failed == 0) Add(Severity::kGood, std::to_string(count) + " images decoded, all sound");
    if (num_pixels > 0) CheckDepth(num_pixels, &depths);
  }

  void CheckDepth(size_t num_pixels, std::vector<float>* depths) {
    if (depths->empty()) {
      Add(Severity::kError, "the depth images hold no measurement at all");
      return;
    }
    const double median = Quantile(0.5, depths);
    const double near = Quantile(0.05, depths);
    const double far = Quantile(0.95, depths);
    const double valid = 100.0 * static_cast<double>(depths->size()) / num_pixels;
    Add(Severity::kGood, "depth: median " + Rounded(median, 2) + " m, 90 % within " +
                             Rounded(near, 2) + " to " + Rounded(far, 2) + " m, " +
                             Rounded(valid, 0) + " % of the pixels measured");
    if (median < 0.3 || median > 8.0) SuggestDepthScale(median);
    if (valid < 20.0) Add(Severity::kWarning, "most of the image has no depth");
  }

  // Rooms are a few metres deep: a median outside 0.3..8 m speaks of a wrong unit.
  void SuggestDepthScale(double median) {
    const double scale = decoder_.calibration().depth_scale;
    std::string text = "a median depth of " + Rounded(median, 3) + " m is unusual; depth_scale (" +
                       Rounded(scale, 1) + " raw units per metre) is probably wrong";
    std::string candidates;
    for (const double other : {1000.0, 5000.0, 6553.5}) {
      const double with_other = median * scale / other;
      if (with_other < 0.3 || with_other > 8.0) continue;
      candidates += (candidates.empty() ? "; " : ", ") + Rounded(other, 1) + " would give " +
                    Rounded(with_other, 2) + " m";
    }
    Add(Severity::kWarning, text + candidates);
  }

  void CheckGroundTruth() {
    const std::vector<TimedPose>& truth = index_.ground_truth;
    if (truth.empty()) {
      Add(Severity::kGood, "no ground truth: replay will not report errors");
      return;
    }
    std::vector<double> truth_stamps, image_stamps;
    for (const TimedPose& pose : truth) truth_stamps.push_back(pose.timestamp);
    for (const SequenceEntry& entry : index_.entries) image_stamps.push_back(entry.timestamp);
    const size_t matched = MatchNearest(truth_stamps, image_stamps, 0.02).size();
    const std::string text = "ground truth: " + std::to_string(truth.size()) + " poses, " +
                             std::to_string(matched) + " of " +
                             std::to_string(image_stamps.size()) + " images have one within 20 ms";
    if (2 * matched >= image_stamps.size()) {
      Add(Severity::kGood, text);
      return;
    }
    Add(Severity::kWarning, text + "; its stamps begin " +
                                Rounded(truth_stamps.front() - image_stamps.front(), 3) +
                                " s after those of the images: other clock, other unit, or the "
                                "truth of another sequence?");
  }

  const RgbdDecoder& decoder_;
  const SequenceIndex& index_;
  const SequenceCheckOptions& options_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> CheckSequence(const RgbdDecoder& decoder,
                                   const SequenceCheckOptions& options) {
  return SequenceChecker(decoder, options).Check();
}

}  // namespace msc_vo
