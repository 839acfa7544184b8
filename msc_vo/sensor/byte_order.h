// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Evidence on the order of the two bytes of raw depth values. Of neighbouring measurements, the
/// difference is small in the correct order: the low byte, which is nearly random, decides it. In
/// the other order that byte is the high one. This holds for every scene, sensor and unit.
class ByteOrder {
 public:
  /// Adds a depth image: CV_32FC1, metres, 0 where nothing was measured, of values of 16 bits with
  /// `depth_scale` units per metre.
  void Add(const cv::Mat& depth, double depth_scale);

  /// Ratio of neighbouring measurements that are closer to each other if their bytes are swapped;
  /// 0 without neighbours that differ.
  double SwappedRatio() const;

  /// Whether the values have the wrong byte order.
  bool IsSwapped() const;

 private:
  // Median of the values, metres, as they are and swapped, if one byte is the same in all of them.
  double MedianDepth(bool swapped) const;

  double depth_scale_ = 1.0;
  int64_t num_pairs_ = 0;    // neighbours whose distance depends on the order
  int64_t num_swapped_ = 0;  // those that are closer with swapped bytes
  int64_t num_values_ = 0;
  std::array<int64_t, 256> low_bytes_{};  // histograms
  std::array<int64_t, 256> high_bytes_{};
};

}  // namespace msc_vo
