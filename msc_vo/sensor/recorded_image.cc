// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/recorded_image.h"

#include <limits>

namespace msc_vo {

RecordedImage::RecordedImage(const cv::Mat& gray, const cv::Mat& depth)
    : rows_(depth.rows), columns_(depth.cols), depth_(depth.total()) {
  gray_.reserve(gray.total());
  for (int y = 0; y < gray.rows; ++y) {
    gray_.insert(gray_.end(), gray.ptr<uint8_t>(y), gray.ptr<uint8_t>(y) + gray.cols);
  }
  cv::Mat units(rows_, columns_, CV_16UC1, depth_.data());
  depth.convertTo(units, CV_16UC1, kUnitsPerMetre);  // NaN becomes 0
  constexpr uint16_t kTooFar = std::numeric_limits<uint16_t>::max();
  units.setTo(0, units == kTooFar);
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
