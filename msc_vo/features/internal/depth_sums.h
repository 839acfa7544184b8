// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace msc_vo {

/// Sums over the pixels of a depth image: 3-D points in units of kUnit, the number of pixels with
/// depth and the number of those at a depth edge. The entry type of an integral image.
///
/// All entries are 32-bit integers that wrap around: differences of integral images are exact as
/// long as the sum over the window fits (kMaxSum).
class DepthSums {
 public:
  /// Metres. Below the resolution of every depth sensor, and coarse enough for 32 bits.
  static constexpr double kUnit = 1e-4;
  /// Largest sum of depths over a window, metres. Leaves a factor of two for rays whose lateral
  /// component exceeds the depth.
  static constexpr double kMaxSum = (1 << 30) * kUnit;

  /// Adds a pixel whose point has the given coordinates, in units of kUnit.
  void AddPoint(int32_t x, int32_t y, int32_t z) {
    sums_[kX] += static_cast<uint32_t>(x);
    sums_[kY] += static_cast<uint32_t>(y);
    sums_[kZ] += static_cast<uint32_t>(z);
    sums_[kCounts] += kOnePoint;
  }
  /// Marks the pixel added last as a depth edge.
  void AddEdge() { sums_[kCounts] += kOneEdge; }

  /// Numbers of pixels, each below 2^16 for a window.
  int NumPoints() const { return static_cast<int>(sums_[kCounts] & (kOneEdge - 1)); }
  int NumEdges() const { return static_cast<int>(sums_[kCounts] / kOneEdge); }

  /// Mean of the points, metres; NumPoints() must not be 0.
  Eigen::Vector3d MeanPoint() const {
    const double scale = kUnit / NumPoints();
    return scale * Eigen::Vector3d(static_cast<int32_t>(sums_[kX]), static_cast<int32_t>(sums_[kY]),
                                   static_cast<int32_t>(sums_[kZ]));
  }

  DepthSums& operator+=(const DepthSums& other) {
    for (int i = 0; i < kSize; ++i) sums_[i] += other.sums_[i];
    return *this;
  }
  DepthSums& operator-=(const DepthSums& other) {
    for (int i = 0; i < kSize; ++i) sums_[i] -= other.sums_[i];
    return *this;
  }
  friend DepthSums operator+(DepthSums a, const DepthSums& b) { return a += b; }
  friend DepthSums operator-(DepthSums a, const DepthSums& b) { return a -= b; }

 private:
  enum { kX, kY, kZ, kCounts, kSize };
  // Two counters in one entry: points in the lower half, edges in the upper half.
  static constexpr uint32_t kOnePoint = 1;
  static constexpr uint32_t kOneEdge = 1u << 16;

  std::array<uint32_t, kSize> sums_{};
};

}  // namespace msc_vo
