// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/image_gradient.h"

#include <algorithm>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

namespace msc_vo {

namespace {

// Computes the gradients of one row. 16-bit arithmetic and non-aliasing pointers let the compiler
// process eight pixels at once.
void Differentiate(const uint8_t* __restrict above, const uint8_t* __restrict here,
                   const uint8_t* __restrict below, int width, int16_t* __restrict x,
                   int16_t* __restrict y, int16_t* __restrict magnitude) {
  for (int i = 1; i < width - 1; ++i) {
    const auto falling = static_cast<int16_t>(below[i + 1] - above[i - 1]);  // the two diagonals
    const auto rising = static_cast<int16_t>(above[i + 1] - below[i - 1]);
    const auto dx = static_cast<int16_t>(falling + rising + here[i + 1] - here[i - 1]);
    const auto dy = static_cast<int16_t>(falling - rising + below[i] - above[i]);
    x[i] = dx;
    y[i] = dy;
    magnitude[i] = static_cast<int16_t>(std::abs(dx) + std::abs(dy));
  }
}

}  // namespace

void ImageGradient::Compute(const cv::Mat& gray) {
  width_ = gray.cols;
  height_ = gray.rows;
  cv::GaussianBlur(gray, smooth_, cv::Size(5, 5), /*sigmaX=*/1.0);
  const size_t num_pixels = gray.total();
  for (std::vector<int16_t>* values : {&x_, &y_, &magnitude_}) {
    values->resize(num_pixels);
    ClearBorder(values);
  }
  for (int row = 1; row + 1 < height_; ++row) {
    const size_t first = static_cast<size_t>(row) * width_;
    Differentiate(smooth_.ptr<uint8_t>(row - 1), smooth_.ptr<uint8_t>(row),
                  smooth_.ptr<uint8_t>(row + 1), width_, &x_[first], &y_[first],
                  &magnitude_[first]);
  }
}

void ImageGradient::ClearBorder(std::vector<int16_t>* values) const {
  std::fill_n(values->begin(), width_, 0);
  std::fill_n(values->end() - width_, width_, 0);
  for (size_t row = 0; row < values->size(); row += width_) {
    (*values)[row] = (*values)[row + width_ - 1] = 0;
  }
}

}  // namespace msc_vo
