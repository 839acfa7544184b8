// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

// The pixels of `image` as views whose surroundings are noise: inside a larger matrix, rows of a
// taller one, a buffer with gaps between its rows, and a buffer that OpenCV takes for continuous.
inline std::vector<cv::Mat> ViewsOf(const cv::Mat& image, uint64_t seed = 1) {
  constexpr int kMargin = 9;  // more than the largest filter reads
  cv::RNG random(seed);
  const auto noise = [&](int rows, int columns) {
    cv::Mat matrix(rows, columns, image.type());
    random.fill(matrix, cv::RNG::UNIFORM, cv::Scalar::all(1.0), cv::Scalar::all(250.0));
    return matrix;
  };
  const cv::Mat larger = noise(image.rows + 2 * kMargin, image.cols + 2 * kMargin);
  const cv::Mat taller = noise(image.rows + 2 * kMargin, image.cols);
  const cv::Mat wider = noise(image.rows, image.cols + kMargin);
  std::vector<cv::Mat> views = {larger(cv::Rect(kMargin, kMargin, image.cols, image.rows)),
                                taller.rowRange(kMargin, kMargin + image.rows),
                                wider.colRange(0, image.cols)};
  for (cv::Mat& view : views) image.copyTo(view);
  return views;
}

}  // namespace msc_vo
