// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

struct FastCorner {
  cv::Point pixel;
  int response = 0;  ///< grey values
};

/// Radius of FAST's circle of 16 pixels.
constexpr int kFastRadius = 3;
/// Minimum image width, pixels: one vector of pixels and the margins.
constexpr int kFastMinColumns = 40;

/// Detects FAST-9 corners of an 8-bit image with centres in `area`, row by row. The response of a
/// pixel is the largest difference by which nine consecutive pixels of its circle are all brighter
/// than it, or all darker. Corners are the strict maxima of the response among 3x3 pixels
/// (including those outside `area`) that exceed `threshold`, in [1, 255].
/// Throws std::invalid_argument if the image is not CV_8UC1, is narrower than kFastMinColumns, or
/// if `area` is closer than kFastRadius + 1 pixels to its border.
std::vector<FastCorner> DetectFastCorners(const cv::Mat& image, const cv::Rect& area,
                                          int threshold);

}  // namespace msc_vo
