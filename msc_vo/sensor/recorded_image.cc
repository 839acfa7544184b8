// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/recorded_image.h"

#include <algorithm>

namespace msc_vo {

RecordedImage::RecordedImage(const cv::Mat& gray, const cv::Mat& depth)
    : rows_(depth.rows), columns_(depth.cols), depth_(depth.total()) {
  constexpr float kScale = static_cast<float>(kUnitsPerMetre);
  constexpr float kTooMany = 65536.0f;  // 0 in 16 bits
  gray_.reserve(gray.total());
  for (int y = 0; y < gray.rows; ++y) {
    gray_.insert(gray_.end(), gray.ptr<uint8_t>(y), gray.ptr<uint8_t>(y) + gray.cols);
  }
  for (int y = 0; y < rows_; ++y) {
    const float* row = depth.ptr<float>(y);
    uint16_t* units = &depth_[static_cast<size_t>(y) * columns_];
    for (int x = 0; x < columns_; ++x) {
      // In this order, NaN becomes 0.
      const float rounded = std::min(kTooMany, std::max(0.0f, kScale * row[x] + 0.5f));
      units[x] = static_cast<uint16_t>(static_cast<int>(rounded));
    }
  }
}

cv::Mat RecordedImage::Depth() const {
  cv::Mat units, metres;
  if (depth_.empty()) return metres;
  units = cv::Mat(depth_).reshape(1, rows_);
  units.convertTo(metres, CV_32FC1, 1.0 / kUnitsPerMetre);
  return metres;
}

cv::Mat RecordedImage::Gray() const {
  return gray_.empty() ? cv::Mat() : cv::Mat(gray_).reshape(1, rows_).clone();
}

}  // namespace msc_vo
