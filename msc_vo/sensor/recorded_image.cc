// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/recorded_image.h"

#include <algorithm>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

namespace {

// Width of the images that are kept. Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kReducedWidth = 320.0;

// The pixels whose coordinates are multiples of the step.
cv::Mat Subsample(const cv::Mat& depth, int step, const cv::Size& size) {
  if (step == 1) return depth;
  cv::Mat reduced(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    const float* from = depth.ptr<float>(step * y);
    float* to = reduced.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) to[x] = from[step * x];
  }
  return reduced;
}

// An image of the full size.
cv::Mat Enlarge(const cv::Mat& reduced, int step, const cv::Size& size) {
  cv::Mat enlarged;
  cv::resize(reduced, enlarged, {}, step, step, cv::INTER_NEAREST);
  return enlarged(cv::Rect({0, 0}, size)).clone();
}

}  // namespace

RecordedImage::RecordedImage(const cv::Mat& gray, const cv::Mat& depth)
    : size_(depth.size()),
      step_(std::max(1, cvRound(depth.cols / kReducedWidth))),
      rows_((depth.rows + step_ - 1) / step_),
      columns_((depth.cols + step_ - 1) / step_),
      depth_(static_cast<size_t>(rows_) * columns_) {
  if (!gray.empty()) {
    gray_.resize(depth_.size());
    cv::Mat reduced(rows_, columns_, CV_8UC1, gray_.data());
    cv::resize(StandaloneImage(gray), reduced, reduced.size(), 0.0, 0.0, cv::INTER_AREA);
  }
  if (depth_.empty()) return;
  cv::Mat units(rows_, columns_, CV_16UC1, depth_.data());
  Subsample(depth, step_, units.size())
      .convertTo(units, CV_16UC1, kUnitsPerMetre);  // NaN becomes 0
  constexpr uint16_t kTooFar = std::numeric_limits<uint16_t>::max();
  units.setTo(0, units == kTooFar);
}

cv::Mat RecordedImage::Depth() const {
  cv::Mat metres;
  if (depth_.empty()) return metres;
  cv::Mat(depth_).reshape(1, rows_).convertTo(metres, CV_32FC1, 1.0 / kUnitsPerMetre);
  return Enlarge(metres, step_, size_);
}

cv::Mat RecordedImage::Gray() const {
  if (gray_.empty()) return {};
  return Enlarge(cv::Mat(gray_).reshape(1, rows_), step_, size_);
}

}  // namespace msc_vo
