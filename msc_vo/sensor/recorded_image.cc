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

// Largest change of the depth of one surface within half the distance of kept pixels, as a ratio:
// that of a plane whose normal is 79 degrees off the line of sight, at a focal length of 0.8 image
// widths.
constexpr double kMaxChange = 0.01;

// The image whose pixel (x, y) is that at (scale * x, scale * y).
cv::Mat Resample(const cv::Mat& image, double scale, const cv::Size& size,
                 cv::InterpolationFlags interpolation) {
  const cv::Matx23d at(scale, 0.0, 0.0, 0.0, scale, 0.0);
  cv::Mat resampled;
  cv::warpAffine(image, resampled, at, size, interpolation | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return resampled;
}

}  // namespace

RecordedImage::RecordedImage(const cv::Mat& gray, const cv::Mat& depth, DepthSensor sensor)
    : sensor_(sensor),
      size_(depth.size()),
      step_(std::max(1, cvRound(depth.cols / kReducedWidth))),
      rows_((depth.rows + step_ - 1) / step_),
      columns_((depth.cols + step_ - 1) / step_),
      depth_(static_cast<size_t>(rows_) * columns_) {
  if (depth_.empty()) return;
  const cv::Size reduced(columns_, rows_);
  if (!gray.empty()) {
    const int window = step_ | 1;  // odd: centred on the kept pixel
    cv::Mat mean;
    cv::blur(StandaloneImage(gray), mean, {window, window});
    gray_.resize(depth_.size());
    Resample(mean, step_, reduced, cv::INTER_NEAREST)
        .copyTo(cv::Mat(rows_, columns_, CV_8UC1, gray_.data()));
  }
  cv::Mat units(rows_, columns_, CV_16UC1, depth_.data());
  Resample(depth, step_, reduced, cv::INTER_NEAREST)
      .convertTo(units, CV_16UC1, kUnitsPerMetre);  // NaN becomes 0
  constexpr uint16_t kTooFar = std::numeric_limits<uint16_t>::max();
  units.setTo(0, units == kTooFar);
}

cv::Mat RecordedImage::Depth() const {
  if (depth_.empty()) return {};
  cv::Mat metres;
  cv::Mat(depth_).reshape(1, rows_).convertTo(metres, CV_32FC1, 1.0 / kUnitsPerMetre);
  if (step_ == 1) return metres;
  cv::Mat depth = Resample(metres, 1.0 / step_, size_, cv::INTER_NEAREST);
  const cv::Mat interpolated = Resample(metres, 1.0 / step_, size_, cv::INTER_LINEAR);
  interpolated.copyTo(depth, cv::abs(interpolated - depth) <= kMaxChange * depth);
  return depth;
}

cv::Mat RecordedImage::Gray() const {
  if (gray_.empty()) return {};
  return Resample(cv::Mat(gray_).reshape(1, rows_), 1.0 / step_, size_, cv::INTER_LINEAR);
}

}  // namespace msc_vo
