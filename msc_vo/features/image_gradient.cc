// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/image_gradient.h"

#include <cstdlib>

#include <opencv2/imgproc.hpp>

namespace msc_vo {

void ImageGradient::Compute(const cv::Mat& gray) {
  width_ = gray.cols;
  height_ = gray.rows;
  cv::GaussianBlur(gray, smooth_, cv::Size(5, 5), /*sigmaX=*/1.0);
  const size_t num_pixels = gray.total();
  for (std::vector<int16_t>* values : {&x_, &y_, &magnitude_}) values->assign(num_pixels, 0);
  for (int row = 1; row + 1 < height_; ++row) {
    const uint8_t* above = smooth_.ptr<uint8_t>(row - 1);
    const uint8_t* here = smooth_.ptr<uint8_t>(row);
    const uint8_t* below = smooth_.ptr<uint8_t>(row + 1);
    int16_t* __restrict x = &x_[static_cast<size_t>(row) * width_];
    int16_t* __restrict y = &y_[static_cast<size_t>(row) * width_];
    int16_t* __restrict magnitude = &magnitude_[static_cast<size_t>(row) * width_];
    for (int i = 1; i + 1 < width_; ++i) {
      const int falling = below[i + 1] - above[i - 1];  // along the two diagonals
      const int rising = above[i + 1] - below[i - 1];
      const int dx = falling + rising + here[i + 1] - here[i - 1];
      const int dy = falling - rising + below[i] - above[i];
      x[i] = static_cast<int16_t>(dx);
      y[i] = static_cast<int16_t>(dy);
      magnitude[i] = static_cast<int16_t>(std::abs(dx) + std::abs(dy));
    }
  }
}

}  // namespace msc_vo
