// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// An RGB-D image as recorded, kept for self-calibration. Its depth has 16 bits per pixel, in
/// quarters of a millimetre up to 16 m.
class RecordedImage {
 public:
  RecordedImage() = default;
  /// `gray`: CV_8UC1, or empty if it is not needed; `depth`: CV_32FC1, metres; 0, NaN: no
  /// measurement. Of equal size.
  RecordedImage(const cv::Mat& gray, const cv::Mat& depth);

  /// Inverse depth of pixel (x, y), 1/metres; 0: no measurement, or outside the image.
  double At(int x, int y) const {
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return 0.0;
    const uint16_t units = depth_[static_cast<size_t>(y) * columns_ + x];
    return units > 0 ? kUnitsPerMetre / units : 0.0;
  }
  /// CV_32FC1, metres; 0: no measurement.
  cv::Mat Depth() const;
  /// CV_8UC1.
  cv::Mat Gray() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [rows, columns, gray, depth] = *this;  // all members, or it does not compile
    archive(rows, columns, gray, depth);
  }

 private:
  static constexpr double kUnitsPerMetre = 4000.0;

  int rows_ = 0;
  int columns_ = 0;
  std::vector<uint8_t> gray_;
  std::vector<uint16_t> depth_;  // 0: no measurement
};

}  // namespace msc_vo
