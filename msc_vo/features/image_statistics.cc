// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/image_statistics.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

namespace {

constexpr int kStride = 8;  // pixels, along rows and columns

// Calls `visit` with every sampled pixel and returns their number.
template <typename Pixel, typename Visit>
int VisitPixels(const cv::Mat& image, const Visit& visit) {
  int count = 0;
  for (int y = 0; y < image.rows; y += kStride) {
    const Pixel* row = image.ptr<Pixel>(y);
    for (int x = 0; x < image.cols; x += kStride) {
      visit(row[x]);
      ++count;
    }
  }
  return count;
}

}  // namespace

ImageStatistics MeasureImage(const RgbdImage& image) {
  ImageStatistics statistics;
  double sum = 0.0, sum_of_squares = 0.0;
  const int num_grey = VisitPixels<uint8_t>(image.gray, [&](double grey) {
    sum += grey;
    sum_of_squares += grey * grey;
  });
  int num_measured = 0;
  const int num_depth = VisitPixels<float>(
      image.depth, [&](float z) { num_measured += z > 0.0f && std::isfinite(z) ? 1 : 0; });
  if (num_grey == 0 || num_depth == 0) return statistics;
  statistics.brightness = sum / num_grey;
  const double variance = sum_of_squares / num_grey - statistics.brightness * statistics.brightness;
  statistics.contrast = std::sqrt(std::max(0.0, variance));
  statistics.measured_depth = static_cast<double>(num_measured) / num_depth;
  return statistics;
}

}  // namespace msc_vo
