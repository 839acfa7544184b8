// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/flying_pixels.h"

#include <cmath>

namespace msc_vo {

namespace {

// Four on one side of a straight edge through the middle of the window, corners included.
constexpr int kMinNeighbours = 4;
// Largest difference between neighbours on one surface, standard deviations of a pixel: three of a
// difference.
constexpr double kMaxSigmas = 4.25;
// Relative change of depth between neighbouring pixels of a surface at a flat angle.
constexpr double kMaxSlope = 0.005;

}  // namespace

cv::Mat RemoveFlyingPixels(const cv::Mat& depth, const DepthNoise& noise) {
  cv::Mat kept = cv::Mat::zeros(depth.size(), CV_32FC1);
  for (int y = 1; y + 1 < depth.rows; ++y) {
    const float* rows[] = {depth.ptr<float>(y - 1), depth.ptr<float>(y), depth.ptr<float>(y + 1)};
    float* out = kept.ptr<float>(y);
    for (int x = 1; x + 1 < depth.cols; ++x) {
      const float z = rows[1][x];
      if (!(z > 0.0f)) continue;
      const double sigma = z * z * noise.At(1.0 / z);
      const auto limit = static_cast<float>(kMaxSigmas * sigma + kMaxSlope * z);
      int count = 0;
      for (const float* row : rows) {
        for (int dx = -1; dx <= 1; ++dx) count += std::abs(row[x + dx] - z) <= limit;
      }
      if (count > kMinNeighbours) out[x] = z;  // the pixel itself is counted
    }
  }
  return kept;
}

}  // namespace msc_vo
