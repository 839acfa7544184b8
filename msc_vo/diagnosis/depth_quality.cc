// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_quality.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/sensor/depth_limits.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Indoor scenes as RGB-D cameras see them: range of the median depth, metres.
constexpr double kMinMedian = 0.6, kMaxMedian = 8.0;
// Raw units per metre of common sources: millimetres, TUM, TUM freiburg2, Replica, 1/256 m, 0.1 mm,
// ScanNet++ and others in 1/4000 m.
const std::vector<double> kScales = {1000.0, 5000.0, 5208.0, 6553.5, 256.0, 10000.0, 4000.0, 100.0};
// The same of floating-point numbers: from millimetres to 100 m.
const std::vector<double> kFloatScales = {1000.0, 100.0, 10.0, 1.0, 0.1, 0.01};
constexpr double kMinValid = 0.2;
constexpr double kShiftedUnits = 8000.0;  // raw units per metre of millimetres times 8

// Ratio of the measurements that have the most frequent value from which on it is no measurement,
// and its excess over the second most frequent one. Walls rendered with depth rounded to 1
// cm, reach 0.14 with an excess of 1.2; icl_of_kt3 (rounded disparity) 0.12 with 3. See
// docs/lab/depth.md.
constexpr double kMaxConstantRatio = 0.05;
constexpr size_t kMinConstantExcess = 10;

bool IsUsual(double median) { return median >= kMinMedian && median <= kMaxMedian; }

// The scales that would give a usual median depth, with the median that each gives.
std::string LikelyScales(double median, const DepthUnits& units) {
  std::string text;
  for (const double other : units.CommonScales()) {
    const double other_median = median * units.per_metre / other;
    if (std::abs(other / units.per_metre - 1.0) < 0.1 || !IsUsual(other_median) ||
        other_median > 5.0) {
      continue;
    }
    const char* const format = units.are_floats ? "%g would give %.2f m" : "%.1f would give %.2f m";
    text += (text.empty() ? "" : ", ") + FormatText(format, other, other_median);
  }
  return text;
}

// Tests whether the raw values are millimetres that were shifted by three bits, as in SUN3D: all
// are multiples of 8, not all of 16.
bool AreShifted(const std::vector<float>& depths, const DepthUnits& units) {
  constexpr size_t kMinValues = 20;  // fewer are multiples by chance
  std::set<double> raw;
  for (const float depth : depths) raw.insert(std::round(depth * units.per_metre));
  const auto are_multiples = [&](double step) {
    return std::all_of(raw.begin(), raw.end(),
                       [&](double value) { return std::fmod(value, step) == 0.0; });
  };
  return !units.are_floats && raw.size() >= kMinValues && are_multiples(8.0) &&
         !are_multiples(16.0);
}

void AddByteOrder(double swapped_ratio, Findings* findings) {
  findings->push_back(
      Error("depth.byte_order",
            FormatText("the two bytes of the depth values are swapped: %.0f %% of the neighbouring "
                       "measurements are closer to each other with swapped bytes",
                       100.0 * swapped_ratio),
            "write the depth images again: PNG stores 16-bit values with the high byte first, a "
            "message of ROS as its is_bigendian says",
            Measurement{swapped_ratio, "ratio"}));
}

// A value that fills parts of the images that no surface fills at a single distance.
void AddConstant(std::vector<float> depths, const DepthUnits& units, Findings* findings) {
  std::sort(depths.begin(), depths.end());
  size_t most = 0, second = 0;
  float value = 0.0f;
  for (auto first = depths.begin(); first != depths.end();) {
    const auto last = std::upper_bound(first, depths.end(), *first);
    const auto count = static_cast<size_t>(last - first);
    second = std::max(second, std::min(count, most));
    if (count > most) {
      most = count;
      value = *first;
    }
    first = last;
  }
  const double ratio = static_cast<double>(most) / static_cast<double>(depths.size());
  if (ratio < kMaxConstantRatio || most < kMinConstantExcess * second) return;
  findings->push_back(Warning(
      "depth.constant",
      FormatText(
          "%.0f %% of the depths are the same, %.3f m (%g raw units), more than ten times as "
          "many as any other value: the end of the range, or filled holes, and no surface",
          100.0 * ratio, value, value * units.per_metre),
      "write 0 where nothing was measured; a run takes this value for a surface",
      Measurement{ratio, "ratio"}));
}

void AddRange(const std::vector<float>& depths, double valid, const DepthUnits& units,
              Findings* findings) {
  const double median = Median(depths);
  const std::string range =
      FormatText("depth: median %.2f m, 90 %% within %.2f to %.2f m, %.0f %% of the pixels valid",
                 median, Quantile(0.05, depths), Quantile(0.95, depths), 100.0 * valid);
  const Measurement measurement{median, "m"};
  const Severity severity = IsUsableDepth(median) ? Severity::kWarning : Severity::kError;
  if (AreShifted(depths, units) && std::abs(units.per_metre / kShiftedUnits - 1.0) > 0.1) {
    findings->push_back(MakeFinding(
        severity, "depth.scale",
        FormatText("all raw depth values are multiples of 8: they may be millimetres shifted by "
                   "three bits, as in SUN3D, with a median depth of %.3f m instead of %.3f m",
                   median * units.per_metre / kShiftedUnits, median),
        FormatText("if so, set depth_scale to %.0f", kShiftedUnits), measurement));
    return;
  }
  if (IsUsual(median)) {
    findings->push_back(Good("depth.scale", range, measurement));
    return;
  }
  const std::string likely = LikelyScales(median, units);
  const std::string option = units.Option();
  const std::string text =
      FormatText("a median depth of %.3f m is unusual; ", median) + option +
      FormatText(units.are_floats ? " (%g units per metre)" : " (%.1f raw units per metre)",
                 units.per_metre) +
      " is probably wrong";
  const std::string fix = likely.empty() ? "look up the units of the depth images"
                                         : "correct " + option + ": " + likely;
  findings->push_back(MakeFinding(severity, "depth.scale", text, fix, measurement));
}

}  // namespace

const std::vector<double>& DepthUnits::CommonScales() const {
  return are_floats ? kFloatScales : kScales;
}

DepthUnits FindDepthUnits(const RgbdDecoder& decoder) {
  constexpr int kMaxTries = 10;
  const DepthUnits raw{decoder.calibration().depth_scale, false};
  for (int i = 0; i < std::min(kMaxTries, decoder.size()); ++i) {
    try {
      if (decoder.DecodeRawDepth(i).type() != CV_32FC1) return raw;
      return {decoder.index().float_depth_scale, true};
    } catch (const UnreadableImage&) {  // reported by the check of the images
    }
  }
  return raw;
}

DepthQuality MeasureDepth(const cv::Mat& depth) {
  DepthQuality quality;
  size_t num_pixels = 0;
  for (int y = 0; y < depth.rows; y += 4) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; x += 4) {
      ++num_pixels;
      if (row[x] > 0.0f) quality.sample.push_back(row[x]);
    }
  }
  if (num_pixels == 0) return quality;
  quality.valid = static_cast<double>(quality.sample.size()) / static_cast<double>(num_pixels);
  return quality;
}

void AddDepthFindings(const std::vector<DepthQuality>& images, const ByteOrder& byte_order,
                      const DepthUnits& units, Findings* findings) {
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
  if (byte_order.IsSwapped()) {
    AddByteOrder(byte_order.SwappedRatio(), findings);
    return;  // nothing else that the values say is true
  }
  AddRange(depths, valid, units, findings);
  AddConstant(depths, units, findings);
  if (valid < kMinValid) {
    findings->push_back(Warning("depth.valid",
                                FormatText("most of the image has no depth: %.0f %% of the pixels "
                                           "are valid",
                                           100.0 * valid),
                                "stay within the range of the sensor; avoid sunlight, glass and "
                                "shiny surfaces",
                                Measurement{valid, "ratio"}));
  }
}

}  // namespace msc_vo
