// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/clipped_depth_search.h"

#include <algorithm>
#include <cstdint>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/sensor/clipped_depth.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kNumImages = 24;
// Ends of the range that are looked for one after the other: the largest value may be a mark for no
// measurement beyond a clipped one.
constexpr int kMaxRounds = 3;

std::vector<cv::Mat> DecodeSample(const SequenceIndex& index, bool* is_metric) {
  const RgbdDecoder decoder(index, Calibration());
  const int count = std::min(kNumImages, decoder.size());
  std::vector<cv::Mat> images;
  for (int k = 0; k < count; ++k) {
    const int64_t last = decoder.size() - 1;
    try {
      const cv::Mat raw =
          decoder.DecodeRawDepth(static_cast<int>(k * last / std::max(count - 1, 1)));
      *is_metric = raw.depth() == CV_32F;
      raw.convertTo(images.emplace_back(), CV_32F);
    } catch (const UnreadableImage&) {
      // Reported when its turn comes.
    }
  }
  return images;
}

// Ratio of the pixels that fulfil the condition.
double RatioOf(const std::vector<cv::Mat>& images, bool (*is_out)(float, const DepthLimits&),
               const DepthLimits& limits) {
  size_t num_out = 0, num_pixels = 0;
  for (const cv::Mat& image : images) {
    num_pixels += image.total();
    num_out += std::count_if(image.begin<float>(), image.end<float>(),
                             [&](float z) { return is_out(z, limits); });
  }
  return static_cast<double>(num_out) / static_cast<double>(num_pixels);
}

std::string Describe(const char* condition, double raw, double metres, double ratio,
                     bool is_metric) {
  const std::string value = is_metric ? "" : FormatText(", raw value %.0f", raw);
  return FormatText("depth is clipped at %.3f m%s: it is that value wherever the scene is %s",
                    metres, value.c_str(), condition) +
         FormatText(" (%.1f %% of the pixels), which does not count as measured", 100.0 * ratio);
}

}  // namespace

ClippedDepth FindClippedDepth(const SequenceIndex& index) {
  ClippedDepth clipped;
  const std::vector<cv::Mat> images = DecodeSample(index, &clipped.is_metric);
  bool has_changed = true;
  for (int round = 0; has_changed && round < kMaxRounds; ++round) {
    has_changed = false;
    ClippedDepthFinder finder(clipped.limits);
    for (const cv::Mat& image : images) has_changed = finder.Add(image) || has_changed;
    clipped.limits = finder.limits();
  }
  if (clipped.limits.HasNearest()) {
    clipped.nearest_ratio = RatioOf(
        images, [](float z, const DepthLimits& l) { return z > 0.0f && z <= l.nearest; },
        clipped.limits);
  }
  if (clipped.limits.HasFarthest()) {
    clipped.farthest_ratio = RatioOf(
        images, [](float z, const DepthLimits& l) { return z >= l.farthest; }, clipped.limits);
  }
  return clipped;
}

std::vector<ClippingReport> DescribeClippedDepth(const ClippedDepth& clipped, double depth_scale) {
  std::vector<ClippingReport> reports;
  const double scale = clipped.is_metric ? 1.0 : depth_scale;
  const auto add = [&](const char* condition, double raw, double ratio) {
    const double metres = raw / scale;
    reports.push_back({metres, Describe(condition, raw, metres, ratio, clipped.is_metric)});
  };
  if (clipped.limits.HasNearest()) {
    add("nearer", clipped.limits.nearest, clipped.nearest_ratio);
  }
  if (clipped.limits.HasFarthest()) {
    add("farther", clipped.limits.farthest, clipped.farthest_ratio);
  }
  return reports;
}

}  // namespace msc_vo
