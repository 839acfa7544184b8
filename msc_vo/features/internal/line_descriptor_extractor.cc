// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_descriptor_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace msc_vo {

namespace {

using Eigen::Vector2d;

constexpr int kBands = 9;
constexpr int kBandWidth = 4;  // rows
constexpr int kRows = kBands * kBandWidth;
// Half the width of the region, and one pixel for rounding.
constexpr int kMargin = kRows / 2 + 2;
// Positions along a row are fixed-point numbers in units of 2^-16 pixels.
constexpr int kFractionBits = 16;

// The four gradient sums of a row: towards the bright side, away from it, along the line, against
// it.
using Row = Eigen::Array4f;
// Means and standard deviations of the four sums over the rows of a band.
using Band = Eigen::Array<float, 8, 1>;

struct BandPair {
  int first;
  int second;
};

// 32 of the 36 pairs of bands. The comparisons of the middle band with the two outermost bands on
// each side carry no information, because the middle band contains the edge itself.
std::array<BandPair, 32> MakePairs() {
  std::array<BandPair, 32> pairs;
  int count = 0;
  for (int i = 0; i < kBands; ++i) {
    for (int j = i + 1; j < kBands; ++j) {
      const bool is_constant = (j == kBands / 2 && i < 2) || (i == kBands / 2 && j >= kBands - 2);
      if (!is_constant) pairs[count++] = {i, j};
    }
  }
  return pairs;
}

// exp(-x^2 / (2 sigma^2)) for the `size` rows around a centre.
template <size_t size>
std::array<float, size> Gaussian(double sigma) {
  std::array<float, size> weights;
  for (size_t i = 0; i < size; ++i) {
    const double x = i - 0.5 * (size - 1.0);
    weights[i] = static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)));
  }
  return weights;
}

// The weight of a row decreases with its distance from the centre of the band.
std::array<Band, kBands> SummarizeBands(const std::array<Row, kRows>& rows) {
  static const std::array<float, 3 * kBandWidth> weights = Gaussian<3 * kBandWidth>(kBandWidth);
  std::array<Band, kBands> bands;
  for (int b = 0; b < kBands; ++b) {
    const int begin = std::max(0, (b - 1) * kBandWidth);
    const int end = std::min(kRows, (b + 2) * kBandWidth);
    Row sum = Row::Zero();
    Row square_sum = Row::Zero();
    for (int r = begin; r < end; ++r) {
      const Row weighted = weights[r - (b - 1) * kBandWidth] * rows[r];
      sum += weighted;
      square_sum += weighted.square();
    }
    const float count = static_cast<float>(end - begin);
    const Row mean = sum / count;
    bands[b] << mean, (square_sum / count - mean.square()).max(0.0f).sqrt();
  }
  return bands;
}

Descriptor CompareBands(const std::array<Band, kBands>& bands) {
  static const std::array<BandPair, 32> pairs = MakePairs();
  Descriptor descriptor;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Band& first = bands[pairs[i].first];
    const Band& second = bands[pairs[i].second];
    int byte = 0;
    for (int k = 0; k < 8; ++k) byte |= (first[k] > second[k] ? 1 : 0) << k;
    descriptor[i] = static_cast<uint8_t>(byte);
  }
  return descriptor;
}

// True if the region of a segment with this end point stays inside the padded image: its rows
// extend (kRows - 1) / 2 pixels at half size to both sides, the padding kMargin.
bool IsNearImage(const Vector2d& end, const cv::Mat& half) {
  constexpr int kHalfRows = (kRows - 1) / 2;
  constexpr double kBefore = 2.0 * (kMargin - kHalfRows);  // full-size pixels
  constexpr double kBehind = kBefore - 1.0;                // rounding may add a pixel
  return end.x() >= -kBefore && end.y() >= -kBefore && end.x() <= 2.0 * half.cols + kBehind &&
         end.y() <= 2.0 * half.rows + kBehind;
}

int ToFixed(double x) { return cvRound(x * (1 << kFractionBits)); }

}  // namespace

void LineDescriptorExtractor::SetImage(const cv::Mat& gray) {
  cv::resize(gray, half_, cv::Size((gray.cols + 1) / 2, (gray.rows + 1) / 2), 0.0, 0.0,
             cv::INTER_AREA);
  cv::copyMakeBorder(half_, padded_, kMargin, kMargin, kMargin, kMargin, cv::BORDER_REPLICATE);
  cv::spatialGradient(padded_, gradient_x_, gradient_y_);
  const std::array<cv::Mat, 2> parts{gradient_x_, gradient_y_};
  cv::merge(parts, both_);
  both_.convertTo(gradient_, CV_32F);
}

// Computes the four gradient sums over a row of `steps` pixels from `first` on in direction `d`.
Row LineDescriptorExtractor::SumRow(const Vector2d& first, const Vector2d& d, int steps) const {
  const size_t stride = gradient_.step1() / 2;
  const cv::Vec2f* const gradient = gradient_.ptr<cv::Vec2f>();
  const Eigen::Array2f along = d.cast<float>();
  const Row by_x(-along.y(), along.y(), along.x(), -along.x());
  const Row by_y(along.x(), -along.x(), along.y(), -along.y());
  const int step_x = ToFixed(d.x());
  const int step_y = ToFixed(d.y());
  // With + 0.5, truncation gives the nearest pixel.
  int x = ToFixed(first.x() + 0.5);
  int y = ToFixed(first.y() + 0.5);
  Row sum = Row::Zero();
  for (int i = 0; i < steps; ++i) {
    const cv::Vec2f& g = gradient[(y >> kFractionBits) * stride + (x >> kFractionBits)];
    sum += (g[0] * by_x + g[1] * by_y).max(0.0f);
    x += step_x;
    y += step_y;
  }
  return sum;
}

Descriptor LineDescriptorExtractor::Describe(const LineSegment2& segment) const {
  if (!IsNearImage(segment.start, half_) || !IsNearImage(segment.end, half_)) return {};
  // Weights of the rows of the region, as in the original.
  static const std::array<float, kRows> weights = Gaussian<kRows>(0.5 * (kRows - 1));
  const Vector2d d = segment.Direction();
  const Vector2d across(-d.y(), d.x());
  const int steps = std::max(1, cvRound(0.5 * segment.Length()));
  // Centre of the line's first pixel, in the padded image.
  const Vector2d first = 0.5 * (segment.start + d) + Vector2d::Constant(kMargin - 0.25);
  std::array<Row, kRows> rows;
  for (int r = 0; r < kRows; ++r) {
    rows[r] = weights[r] * SumRow(first + (r - 0.5 * (kRows - 1)) * across, d, steps);
  }
  return CompareBands(SummarizeBands(rows));
}

}  // namespace msc_vo
