// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/byte_order.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "msc_vo/sensor/depth_limits.h"

namespace msc_vo {

namespace {

constexpr int kTestedRowStep = 4;
// Pairs of random values are closer in either order with the same probability. Of measured ones,
// 0 to 6 % are closer in the wrong order, see docs/lab/depth.md.
constexpr double kMinSwappedRatio = 0.75;
constexpr int64_t kMinPairs = 100;  // five standard deviations of random values
// Ratio of the values that share a byte which is the same in all but a few damaged ones.
constexpr double kConstantRatio = 0.99;

uint16_t SwapBytes(uint16_t value) { return static_cast<uint16_t>(value << 8 | value >> 8); }

int Distance(uint16_t a, uint16_t b) { return std::abs(static_cast<int>(a) - static_cast<int>(b)); }

// Most frequent byte.
int ModeOf(const std::array<int64_t, 256>& histogram) {
  return static_cast<int>(std::max_element(histogram.begin(), histogram.end()) - histogram.begin());
}

int MedianOf(const std::array<int64_t, 256>& histogram, int64_t total) {
  int64_t below = 0;
  int value = 0;
  while (value < 255 && 2 * (below + histogram[value]) < total) below += histogram[value++];
  return value;
}

}  // namespace

void ByteOrder::Add(const cv::Mat& depth, double depth_scale) {
  depth_scale_ = depth_scale;
  const auto scale = static_cast<float>(depth_scale);
  for (int y = 0; y < depth.rows; y += kTestedRowStep) {
    const auto* row = depth.ptr<float>(y);
    uint16_t last = 0;
    for (int x = 0; x < depth.cols; ++x) {
      if (!(row[x] > 0.0f)) continue;
      const float units = std::min(std::round(row[x] * scale), static_cast<float>(UINT16_MAX));
      const auto value = static_cast<uint16_t>(units);
      ++num_values_;
      ++low_bytes_[value & 0xFF];
      ++high_bytes_[value >> 8];
      const int as_is = Distance(last, value);
      const int swapped = Distance(SwapBytes(last), SwapBytes(value));
      if (last != 0 && as_is != swapped) {
        ++num_pairs_;
        if (swapped < as_is) ++num_swapped_;
      }
      last = value;
    }
  }
}

double ByteOrder::SwappedRatio() const {
  return num_pairs_ == 0 ? 0.0
                         : static_cast<double>(num_swapped_) / static_cast<double>(num_pairs_);
}

double ByteOrder::MedianDepth(bool swapped) const {
  const int low = ModeOf(low_bytes_), high = MedianOf(high_bytes_, num_values_);
  return (swapped ? 256 * low + high : 256 * high + low) / depth_scale_;
}

bool ByteOrder::IsSwapped() const {
  if (num_pairs_ < kMinPairs || SwappedRatio() < kMinSwappedRatio) return false;
  const auto num_constant = static_cast<double>(low_bytes_[ModeOf(low_bytes_)]);
  if (num_constant < kConstantRatio * static_cast<double>(num_values_)) return true;
  // Coarse depth in the high byte alone, or depth of less than 256 units with swapped bytes: both
  // are smooth in both orders, and only their size differs.
  return !IsUsableDepth(MedianDepth(false)) && IsUsableDepth(MedianDepth(true));
}

}  // namespace msc_vo
