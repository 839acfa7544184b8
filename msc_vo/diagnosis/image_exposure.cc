// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/image_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Histogram = std::array<int, 256>;

constexpr int kSaturatedLevel = 250;
constexpr double kMaxSaturated = 0.2;
constexpr double kMinBrightLevel = 60.0;
// Edge width at an image width of 640 pixels, from the distributions in docs/usage.md.
constexpr double kMaxEdgeWidth = 9.0;
// Ratio of images with a defect that is worth a warning, and that makes a run useless.
constexpr double kWarningRatio = 0.2, kBlurRatio = 0.4, kErrorRatio = 0.5;

Histogram HistogramOf(const cv::Mat& gray) {
  Histogram histogram = {};
  for (int y = 0; y < gray.rows; y += 2) {
    const uint8_t* row = gray.ptr<uint8_t>(y);
    for (int x = 0; x < gray.cols; x += 2) ++histogram[row[x]];
  }
  return histogram;
}

// Width of the widest image that edges are measured in, pixels: blur of a larger one would exceed
// their extent, and their slope would be that of noise.
constexpr int kMaxWidth = 640;

// Widths of the edges in the rows of the image at local maxima of the horizontal gradient.
double MedianEdgeWidth(const cv::Mat& gray) {
  constexpr int kReach = 8;          // pixels, on either side of the edge
  constexpr double kMinSlope = 4.0;  // grey levels per pixel
  constexpr size_t kMinEdges = 50;
  struct Edge {
    double slope;
    double width;
  };
  std::vector<Edge> edges;
  for (int y = 1; y + 1 < gray.rows; y += 2) {
    const uint8_t* row = gray.ptr<uint8_t>(y);
    const auto slope = [row](int x) { return 0.5 * (row[x + 1] - row[x - 1]); };
    for (int x = kReach + 1; x + kReach + 1 < gray.cols; ++x) {
      const double s = slope(x);
      const double magnitude = std::abs(s);
      if (magnitude < kMinSlope || std::abs(slope(x - 1)) > magnitude ||
          std::abs(slope(x + 1)) >= magnitude) {
        continue;
      }
      // The edge extends as far as the grey levels are monotonic.
      const int sign = s > 0.0 ? 1 : -1;
      int left = x - 1, right = x + 1;
      while (left > x - kReach && sign * (row[left] - row[left - 1]) > 0) --left;
      while (right < x + kReach && sign * (row[right + 1] - row[right]) > 0) ++right;
      edges.push_back({magnitude, std::abs(row[right] - row[left]) / magnitude});
    }
  }
  if (edges.size() < kMinEdges) return 0.0;
  // The strongest quarter: weak edges are shading and noise.
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 4);
  std::nth_element(edges.begin(), middle, edges.end(),
                   [](const Edge& a, const Edge& b) { return a.slope > b.slope; });
  std::vector<double> widths;
  for (auto edge = edges.begin(); edge != middle; ++edge) widths.push_back(edge->width);
  return Median(std::move(widths));
}

bool IsUniform(const ImageExposure& image) { return image.contrast < kMinImageContrast; }

// The images with a property, of all that are decoded.
struct Count {
  size_t count = 0;
  size_t size = 0;

  double Ratio() const { return static_cast<double>(count) / static_cast<double>(size); }
  // With the verb: "1 of 4 decoded images (25 %) is".
  std::string Text() const {
    return FormatText("%zu of %zu decoded images (%.0f %%) %s", count, size, 100.0 * Ratio(),
                      count == 1 ? "is" : "are");
  }
};

template <typename Predicate>
Count CountOf(const std::vector<ImageExposure>& images, const Predicate& has_property) {
  return {static_cast<size_t>(std::count_if(images.begin(), images.end(), has_property)),
          images.size()};
}

// Uniform images with or without depth. Planes of the depth images need no colour.
void AddUniform(const std::vector<ImageExposure>& images, bool with_depth, Findings* findings) {
  const auto is_meant = [with_depth](const ImageExposure& image) {
    return IsUniform(image) && (image.measured_depth >= kMinMeasuredDepth) == with_depth;
  };
  const Count uniform = CountOf(images, is_meant);
  if (uniform.count == 0) return;
  std::vector<double> means;
  for (const ImageExposure& image : images) {
    if (is_meant(image)) means.push_back(image.mean);
  }
  const double mean = Median(std::move(means));
  const char* kind = mean < 40.0 ? "black" : mean > 215.0 ? "white" : "uniformly grey";
  const std::string text = uniform.Text() + FormatText(" %s (median grey level %.0f), %s depth",
                                                       kind, mean, with_depth ? "with" : "without");
  const Measurement measurement{uniform.Ratio(), "ratio"};
  if (with_depth) {
    findings->push_back(
        Warning("images.uniform", text,
                "planes of the depth images can give poses there, if their normals "
                "span three directions (mode msc-vo, the default), once an image with "
                "features has begun the map; if the images should show more, check "
                "lens cap, light and exposure",
                measurement));
    return;
  }
  const auto add = uniform.Ratio() > kErrorRatio ? Error : Warning;
  findings->push_back(add("images.uniform", text,
                          "check lens cap, light and exposure; leave these images out",
                          measurement));
}

void AddExposure(const std::vector<ImageExposure>& images, Findings* findings) {
  const size_t before = findings->size();
  const Count saturated = CountOf(images, [](const ImageExposure& image) {
    return image.saturated > kMaxSaturated && !IsUniform(image);
  });
  if (saturated.Ratio() > kWarningRatio) {
    findings->push_back(
        Warning("images.overexposed",
                saturated.Text() + FormatText(" over-exposed: more than %.0f %% of the pixels are "
                                              "white",
                                              100.0 * kMaxSaturated),
                "shorten the exposure; white areas have no points and no lines",
                Measurement{saturated.Ratio(), "ratio"}));
  }
  const Count dim = CountOf(images, [](const ImageExposure& image) {
    return image.bright_level < kMinBrightLevel && !IsUniform(image);
  });
  if (dim.Ratio() > kWarningRatio) {
    findings->push_back(Warning(
        "images.dim",
        dim.Text() +
            FormatText(" dim: 95 %% of the pixels are below grey level %.0f", kMinBrightLevel),
        "more light or gain; or lower features.points.fast_threshold",
        Measurement{dim.Ratio(), "ratio"}));
  }
  if (findings->size() > before) return;
  std::vector<double> means, contrasts;
  for (const ImageExposure& image : images) {
    if (IsUniform(image)) continue;  // reported by AddUniform()
    means.push_back(image.mean);
    contrasts.push_back(image.contrast);
  }
  if (means.empty()) return;
  const double mean = Median(std::move(means));
  findings->push_back(Good("images.exposure",
                           FormatText("exposure: median grey level %.0f, contrast %.0f", mean,
                                      Median(std::move(contrasts))),
                           Measurement{mean, "grey levels"}));
}

void AddBlur(const std::vector<ImageExposure>& images, int width, Findings* findings) {
  std::vector<double> widths;
  for (const ImageExposure& image : images) {
    if (image.edge_width > 0.0) widths.push_back(image.edge_width);
  }
  if (widths.empty()) return;
  // The optics limit sharpness relative to the image; a pixel is the least width that is visible.
  const double limit = std::max(4.5, kMaxEdgeWidth * width / 640.0);
  const auto num_blurred =
      std::count_if(widths.begin(), widths.end(), [limit](double value) { return value > limit; });
  const size_t num_with_edges = widths.size();
  const double ratio = static_cast<double>(num_blurred) / static_cast<double>(num_with_edges);
  const double median = Median(std::move(widths));
  const std::string text = FormatText(
      "sharpness: edges are %.1f px wide in the median image, wider than %.1f px in %td of %zu "
      "decoded images with edges",
      median, limit, num_blurred, num_with_edges);
  if (ratio <= kBlurRatio) {
    findings->push_back(Good("images.blur", text, Measurement{median, "px"}));
    return;
  }
  findings->push_back(Warning("images.blur", text,
                              "blurred: focus the lens, move more slowly, or shorten the exposure",
                              Measurement{median, "px"}));
}

}  // namespace

ImageExposure MeasureExposure(const cv::Mat& gray) {
  ImageExposure exposure;
  const Histogram histogram = HistogramOf(gray);
  double count = 0.0, sum = 0.0, squares = 0.0, saturated = 0.0;
  for (int level = 0; level < 256; ++level) {
    const double n = histogram[level];
    count += n;
    sum += n * level;
    squares += n * level * level;
    if (level >= kSaturatedLevel) saturated += n;
  }
  if (count == 0.0) return exposure;
  exposure.mean = sum / count;
  exposure.contrast = std::sqrt(std::max(0.0, squares / count - exposure.mean * exposure.mean));
  exposure.saturated = saturated / count;
  double above = 0.0;
  int level = 255;
  for (; level > 0 && above + histogram[level] <= 0.05 * count; --level) above += histogram[level];
  exposure.bright_level = level;
  const double reduction = std::max(1.0, static_cast<double>(gray.cols) / kMaxWidth);
  cv::Mat reduced = gray;
  if (reduction > 1.0) {
    cv::resize(gray, reduced, {}, 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
  }
  exposure.edge_width = reduction * MedianEdgeWidth(reduced);
  return exposure;
}

void AddExposureFindings(const std::vector<ImageExposure>& images, int width, Findings* findings) {
  if (images.empty()) return;
  for (const bool with_depth : {false, true}) AddUniform(images, with_depth, findings);
  AddExposure(images, findings);
  AddBlur(images, width, findings);
}

}  // namespace msc_vo
