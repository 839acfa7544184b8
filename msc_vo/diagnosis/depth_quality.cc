// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_quality.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Indoor scenes as RGB-D cameras see them: range of the median depth, metres.
constexpr double kMinMedian = 0.6, kMaxMedian = 8.0;
// Outside this range no depth factor of a camera is right, and no feature has a usable depth.
constexpr double kMinUsableMedian = 0.1, kMaxUsableMedian = 40.0;
// Raw units per metre of common sources: millimetres, TUM, TUM freiburg2, Replica, 1/256 m, 0.1 mm,
// ScanNet++ and others in 1/4000 m.
constexpr double kScales[] = {1000.0, 5000.0, 5208.0, 6553.5, 256.0, 10000.0, 4000.0, 100.0};
constexpr double kMinValid = 0.2, kMaxSaturated = 0.01;
// Neighbouring depths differ by a few per cent at most, byte-swapped ones by a quarter.
constexpr double kMaxRoughness = 0.05, kSwappedGain = 4.0;

uint16_t SwapBytes(uint16_t value) { return static_cast<uint16_t>(value << 8 | value >> 8); }

double RelativeDifference(int a, int b) {
  return std::abs(a - b) / (static_cast<double>(a) + static_cast<double>(b));
}

bool IsUsual(double median) { return median >= kMinMedian && median <= kMaxMedian; }

// The scales that would give a usual median depth, with the median that each gives.
std::string LikelyScales(double median, double scale) {
  std::string text;
  for (const double other : kScales) {
    const double other_median = median * scale / other;
    if (std::abs(other / scale - 1.0) < 0.1 || !IsUsual(other_median) || other_median > 5.0) {
      continue;
    }
    text += (text.empty() ? "" : ", ") + FormatText("%.1f would give %.2f m", other, other_median);
  }
  return text;
}

void AddByteOrder(const std::vector<DepthQuality>& images, bool* is_swapped, Findings* findings) {
  std::vector<double> as_is, swapped;
  for (const DepthQuality& image : images) {
    if (image.roughness <= 0.0) continue;
    as_is.push_back(image.roughness);
    swapped.push_back(image.swapped_roughness);
  }
  const double roughness = Median(std::move(as_is));
  const double swapped_roughness = Median(std::move(swapped));
  *is_swapped = roughness > kMaxRoughness && roughness > kSwappedGain * swapped_roughness;
  if (!*is_swapped) return;
  findings->push_back(
      Error("depth.byte_order",
            FormatText("the two bytes of the depth values are swapped: neighbouring pixels differ "
                       "by %.0f %%, with swapped bytes by %.1f %%",
                       200.0 * roughness, 200.0 * swapped_roughness),
            "write the depth images again; PNG stores 16-bit values with the high byte first",
            Measurement{roughness, "ratio"}));
}

void AddRange(const std::vector<float>& depths, double valid, double scale, Findings* findings) {
  const double median = Median(depths);
  const std::string range =
      FormatText("depth: median %.2f m, 90 %% within %.2f to %.2f m, %.0f %% of the pixels valid",
                 median, Quantile(0.05, depths), Quantile(0.95, depths), 100.0 * valid);
  const Measurement measurement{median, "m"};
  if (IsUsual(median)) {
    findings->push_back(Good("depth.scale", range, measurement));
    return;
  }
  const std::string likely = LikelyScales(median, scale);
  const std::string text = FormatText(
      "a median depth of %.3f m is unusual; depth_scale (%.1f raw units per metre) is probably "
      "wrong",
      median, scale);
  const std::string fix =
      likely.empty() ? "look up the units of the depth images" : "correct depth_scale: " + likely;
  const bool usable = median >= kMinUsableMedian && median <= kMaxUsableMedian;
  findings->push_back(usable ? Warning("depth.scale", text, fix, measurement)
                             : Error("depth.scale", text, fix, measurement));
}

void AddSaturation(const std::vector<DepthQuality>& images, Findings* findings) {
  std::vector<double> ratios;
  for (const DepthQuality& image : images) ratios.push_back(image.saturated);
  const double ratio = Quantile(0.9, std::move(ratios));
  if (ratio <= kMaxSaturated) return;
  findings->push_back(
      Warning("depth.saturated",
              FormatText("%.0f %% of the depth pixels have the largest value, 65535: saturated, or "
                         "a mark for no measurement",
                         100.0 * ratio),
              "write 0 where nothing was measured, or use fewer units per metre",
              Measurement{ratio, "ratio"}));
}

}  // namespace

DepthQuality MeasureDepth(const cv::Mat& depth, double depth_scale) {
  DepthQuality quality;
  std::vector<double> as_is, swapped;
  size_t num_pixels = 0, num_valid = 0, num_saturated = 0;
  const auto scale = static_cast<float>(depth_scale);
  for (int y = 0; y < depth.rows; y += 4) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; x += 4) {
      ++num_pixels;
      if (row[x] <= 0.0f) continue;
      ++num_valid;
      quality.sample.push_back(row[x]);
      const auto a = static_cast<uint16_t>(std::lround(row[x] * scale));
      if (a == UINT16_MAX) ++num_saturated;
      if (x + 1 >= depth.cols || row[x + 1] <= 0.0f) continue;
      const auto b = static_cast<uint16_t>(std::lround(row[x + 1] * scale));
      if (a == b) continue;
      as_is.push_back(RelativeDifference(a, b));
      swapped.push_back(RelativeDifference(SwapBytes(a), SwapBytes(b)));
    }
  }
  if (num_pixels == 0) return quality;
  quality.valid = static_cast<double>(num_valid) / static_cast<double>(num_pixels);
  quality.saturated = static_cast<double>(num_saturated) / static_cast<double>(num_pixels);
  quality.roughness = Median(std::move(as_is));
  quality.swapped_roughness = Median(std::move(swapped));
  return quality;
}

void AddDepthFindings(const std::vector<DepthQuality>& images, double depth_scale,
                      Findings* findings) {
  if (images.empty()) return;
  std::vector<float> depths;
  double valid = 0.0;
  for (const DepthQuality& image : images) {
    depths.insert(depths.end(), image.sample.begin(), image.sample.end());
    valid += image.valid / static_cast<double>(images.size());
  }
  if (depths.empty()) {
    findings->push_back(Error("depth.valid", "the depth images hold no measurement at all",
                              "check that the depth stream was recorded"));
    return;
  }
  bool is_swapped = false;
  AddByteOrder(images, &is_swapped, findings);
  if (is_swapped) return;  // nothing else that the values say is true
  AddRange(depths, valid, depth_scale, findings);
  if (valid < kMinValid) {
    findings->push_back(Warning("depth.valid",
                                FormatText("most of the image has no depth: %.0f %% of the pixels "
                                           "are valid",
                                           100.0 * valid),
                                "stay within the range of the sensor; avoid sunlight, glass and "
                                "shiny surfaces",
                                Measurement{valid, "ratio"}));
  }
  AddSaturation(images, findings);
}

}  // namespace msc_vo
