// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>

#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/evaluation/association.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMaxReportsOfOneKind = 5;

// Returns the p-quantile of the samples, 0 <= p <= 1; reorders them.
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
    int num_unreadable = 0;
    for (const SequenceEntry& entry : index_.entries) {
      for (const std::string& path : {entry.color_path, entry.depth_path}) {
        const std::string problem = FileProblem(path, kMaxImageBytes);
        if (problem.empty()) continue;
        if (++num_unreadable > kMaxReportsOfOneKind) continue;
        Add(Severity::kError, path + " " + problem +
                                  (entry.origin.empty() ? "" : " (named in " + entry.origin + ")"));
      }
    }
    if (num_unreadable == 0) Add(Severity::kGood, "all image files exist");
    if (num_unreadable > kMaxReportsOfOneKind) {
      Add(Severity::kError,
          FormatText("%d image files in total are missing or unreadable", num_unreadable));
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
    Add(Severity::kGood, FormatText("%zu image pairs in %.1f s, %.1f per second", entries.size(),
                                    duration, 1.0 / median));
    constexpr double kMinInterval = 0.001, kMaxInterval = 5.0;  // seconds, of RGB-D cameras
    if (median < kMinInterval || median > kMaxInterval) {
      Add(Severity::kWarning,
          FormatText("the median interval between images is %g s: are the stamps in seconds?",
                     median));
    }
    // The constant velocity model bridges one or two dropped frames, not more.
    constexpr double kMaxGap = 3.5;  // in median intervals
    const auto gaps = std::count_if(intervals.begin(), intervals.end(),
                                    [&](double interval) { return interval > kMaxGap * median; });
    if (gaps > 0) {
      const double longest = *std::max_element(intervals.begin(), intervals.end());
      Add(Severity::kWarning, FormatText("%d gaps of three frames or more, the longest %.3f s",
                                         static_cast<int>(gaps), longest));
    }
  }

  void CheckDelays() {
    const auto [first, last] = std::minmax_element(
        index_.entries.begin(), index_.entries.end(),
        [](const auto& a, const auto& b) { return a.depth_delay < b.depth_delay; });
    if (first->depth_delay == 0.0 && last->depth_delay == 0.0) return;
    Add(Severity::kGood,
        FormatText("depth images are %.1f to %.1f ms later than their colour images; replay "
                   "compensates for the motion of the camera in that time",
                   1e3 * first->depth_delay, 1e3 * last->depth_delay));
  }

  void CheckCamera() {
    const Calibration& calibration = decoder_.calibration();
    const PinholeCamera& camera = calibration.camera;
    Add(Severity::kGood,
        "camera from " + calibration.origin +
            FormatText(": fx %.3f, fy %.3f, cx %.3f, cy %.3f, %dx%d, %.1f depth units per metre",
                       camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height,
                       calibration.depth_scale) +
            (calibration.distortion.IsZero() ? "" : ", with lens distortion"));
    if (calibration.depth_camera) CheckDepthCamera(*calibration.depth_camera);
    if (camera.fy < 0.0 && index_.format != "icl-nuim") {
      Add(Severity::kWarning, "fy is negative: correct only for mirrored images (ICL-NUIM)");
    }
    if (camera.fy > 0.0 && index_.format == "icl-nuim") {
      Add(Severity::kWarning,
          "fy is positive, but original ICL-NUIM images are mirrored: their ground truth requires "
          "fy = -480");
    }
    if (std::abs(std::abs(camera.fx / camera.fy) - 1.0) > 0.1) {
      Add(Severity::kWarning,
          "fx and fy differ by more than 10 %, but pixels are nearly always square: check both");
    }
    const bool centred = std::abs(camera.cx / camera.width - 0.5) < 0.2 &&
                         std::abs(camera.cy / camera.height - 0.5) < 0.2;
    if (!centred) {
      Add(Severity::kWarning,
          "cx and cy are far from the image centre: is the calibration for another image size?");
    }
  }

  void CheckDepthCamera(const DepthCamera& depth_camera) {
    const PinholeCamera& camera = depth_camera.camera;
    const Eigen::Vector3d t = depth_camera.depth_from_color.translation();
    const double angle =
        depth_camera.depth_from_color.rotation().angularDistance(Eigen::Quaterniond::Identity());
    Add(Severity::kGood,
        FormatText("depth camera: fx %.3f, fy %.3f, cx %.3f, cy %.3f, %dx%d, depth_from_color "
                   "translation %.4f %.4f %.4f m, rotation %.2f degrees; depth is registered to "
                   "colour on reading",
                   camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height, t.x(),
                   t.y(), t.z(), RadiansToDegrees(angle)));
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
        // Every 16th pixel suffices for the distribution.
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
    if (failed == 0) Add(Severity::kGood, std::to_string(count) + " images decoded without errors");
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
    Add(Severity::kGood,
        FormatText("depth: median %.2f m, 90 %% within %.2f to %.2f m, %.0f %% of the pixels valid",
                   median, near, far, valid));
    if (!IsUsualDepth(median)) SuggestDepthScale(median);
    if (valid < 20.0) Add(Severity::kWarning, "most of the image has no depth");
  }

  // Rooms are a few metres deep: another median indicates a wrong unit. Metres.
  static bool IsUsualDepth(double median) { return median >= 0.3 && median <= 8.0; }

  void SuggestDepthScale(double median) {
    const double scale = decoder_.calibration().depth_scale;
    std::string text = FormatText(
        "a median depth of %.3f m is unusual; depth_scale (%.1f raw units per metre) is probably "
        "wrong",
        median, scale);
    const char* separator = "; ";
    for (const double other_scale : {1000.0, 5000.0, 6553.5}) {
      const double other_median = median * scale / other_scale;
      if (!IsUsualDepth(other_median)) continue;
      text += separator + FormatText("%.1f would give %.2f m", other_scale, other_median);
      separator = ", ";
    }
    Add(Severity::kWarning, text);
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
    const size_t num_matched =
        AssociateStamps(truth_stamps, image_stamps, kMaxPairDifference).size();
    const std::string text =
        FormatText("ground truth: %zu poses, %zu of %zu images have one within %.0f ms",
                   truth.size(), num_matched, image_stamps.size(), 1e3 * kMaxPairDifference);
    if (2 * num_matched >= image_stamps.size()) {
      Add(Severity::kGood, text);
      return;
    }
    Add(Severity::kWarning,
        text + FormatText("; its stamps begin %.3f s after those of the images: is it on another "
                          "clock, in another unit, or of another sequence?",
                          truth_stamps.front() - image_stamps.front()));
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
