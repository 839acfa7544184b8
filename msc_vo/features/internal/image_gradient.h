// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Gradient of a smoothed grey image: Gaussian of sigma 1 px, then Prewitt's operator (differences
/// over two pixels, summed over three rows or columns). The index of a pixel is y * width() + x.
/// Keeps its buffers between calls.
class ImageGradient {
 public:
  /// `gray` is CV_8UC1.
  void Compute(const cv::Mat& gray);

  int width() const { return width_; }
  int height() const { return height_; }
  int X(int pixel) const { return x_[pixel]; }
  int Y(int pixel) const { return y_[pixel]; }
  /// |X| + |Y|; 0 on the border of the image.
  int Magnitude(int pixel) const { return magnitude_[pixel]; }
  /// The magnitudes of a row, and its components along y.
  const int16_t* MagnitudesOf(int row) const {
    return &magnitude_[static_cast<size_t>(row) * width_];
  }
  const int16_t* YsOf(int row) const { return &y_[static_cast<size_t>(row) * width_]; }
  /// True if an edge through the pixel is closer to the x axis than to the y axis.
  bool IsHorizontalEdge(int pixel) const {
    return 2 * std::abs(static_cast<int>(y_[pixel])) >= magnitude_[pixel];
  }

 private:
  void ClearBorder(std::vector<int16_t>* values) const;

  int width_ = 0;
  int height_ = 0;
  cv::Mat smooth_;
  std::vector<int16_t> x_, y_, magnitude_;
};

}  // namespace msc_vo
