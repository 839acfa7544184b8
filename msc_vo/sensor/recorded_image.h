// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/depth_sensor.h"

namespace msc_vo {

/// An RGB-D image as recorded, reduced to about 320 pixels in width and kept for self-calibration.
/// Its depth has 16 bits per pixel, in quarters of a millimetre up to 16 m.
class RecordedImage {
 public:
  RecordedImage() = default;
  /// `gray`: CV_8UC1, or empty if it is not needed; `depth`: CV_32FC1, metres; 0, NaN: no
  /// measurement. Of equal size. `sensor`: that took the depth.
  RecordedImage(const cv::Mat& gray, const cv::Mat& depth, DepthSensor sensor);

  DepthSensor sensor() const { return sensor_; }

  /// Distance between two kept pixels, in pixels of the full image.
  int step() const { return step_; }
  /// Inverse depth, 1/metres, of the pixel whose coordinates in the full image are step() times
  /// `column` and `row`; 0: no measurement, or outside the image.
  double At(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return 0.0;
    const uint16_t units = depth_[static_cast<size_t>(row) * columns_ + column];
    return units > 0 ? kUnitsPerMetre / units : 0.0;
  }
  /// CV_32FC1 of the full size, metres; 0: no measurement. Between kept pixels, the depth is
  /// interpolated on one surface, and that of the nearest one at an edge.
  cv::Mat Depth() const;
  /// CV_8UC1 of the full size, interpolated between the means around the kept pixels.
  cv::Mat Gray() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [sensor, size, step, rows, columns, gray, depth] = *this;  // all members
    archive(sensor, size.width, size.height, step, rows, columns, gray, depth);
  }

 private:
  static constexpr double kUnitsPerMetre = 4000.0;

  DepthSensor sensor_ = DepthSensor::kStructuredLight;
  cv::Size size_;  // of the full image
  int step_ = 1;
  int rows_ = 0;
  int columns_ = 0;
  std::vector<uint8_t> gray_;
  std::vector<uint16_t> depth_;  // 0: no measurement
};

}  // namespace msc_vo
