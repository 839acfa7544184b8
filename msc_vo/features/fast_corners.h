// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

struct FastCorner {
  cv::Point pixel;
  int response = 0;  // grey values
};

// Of the circle of 16 pixels that FAST looks at.
constexpr int kFastRadius = 3;
// Narrower images are not looked at: a row is computed this many pixels at once, less the margins.
constexpr int kFastMinColumns = 40;

// FAST-9 corners of an 8-bit image whose centres lie in `area`, row by row. The response of a pixel
// is the largest difference by which nine neighbours on the circle are all brighter than it, or all
// darker; corners are its strict maxima among 3x3 pixels, also across the border of the area, that
// exceed `threshold`, in [1, 255]. Throws std::invalid_argument if the image is not CV_8UC1 of at
// least kFastMinColumns or `area` is nearer than kFastRadius + 1 pixels to its border.
std::vector<FastCorner> DetectFastCorners(const cv::Mat& image, const cv::Rect& area,
                                          int threshold);

}  // namespace msc_vo
