// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/recorded_image.h"

#include <limits>

namespace msc_vo {

namespace {

constexpr float kUnitsPerMetre = 4000.0f;
constexpr float kMaxUnits = std::numeric_limits<uint16_t>::max();

}  // namespace

RecordedImage::RecordedImage(const cv::Mat& gray, const cv::Mat& depth)
    : rows_(depth.rows), columns_(depth.cols) {
  gray_.reserve(depth.total());
  depth_.reserve(depth.total());
  for (int y = 0; y < rows_; ++y) {
    gray_.insert(gray_.end(), gray.ptr<uint8_t>(y), gray.ptr<uint8_t>(y) + columns_);
    const float* row = depth.ptr<float>(y);
    for (int x = 0; x < columns_; ++x) {
      const float units = kUnitsPerMetre * row[x] + 0.5f;
      depth_.push_back(units >= 1.0f && units <= kMaxUnits ? static_cast<uint16_t>(units) : 0);
    }
  }
}

double RecordedImage::At(int x, int y) const {
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return 0.0;
  const uint16_t units = depth_[static_cast<size_t>(y) * columns_ + x];
  return units > 0 ? static_cast<double>(kUnitsPerMetre) / units : 0.0;
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
