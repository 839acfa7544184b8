// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

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

  DepthSums() = default;

  /// Adds a pixel by the coordinates of its point, in units of kUnit.
  void AddPoint(int32_t x, int32_t y, int32_t z, bool is_edge) {
    x_ += static_cast<uint32_t>(x);
    y_ += static_cast<uint32_t>(y);
    z_ += static_cast<uint32_t>(z);
    counts_ += is_edge ? kOnePoint + kOneEdge : kOnePoint;
  }

  /// Numbers of pixels, each below 2^16 for a window.
  int NumPoints() const { return static_cast<int>(counts_ & (kOneEdge - 1)); }
  int NumEdges() const { return static_cast<int>(counts_ / kOneEdge); }

  /// Mean of the points, metres; NumPoints() must not be 0.
  Eigen::Vector3d MeanPoint() const {
    const double scale = kUnit / NumPoints();
    return scale * Eigen::Vector3d(static_cast<int32_t>(x_), static_cast<int32_t>(y_),
                                   static_cast<int32_t>(z_));
  }

  friend DepthSums operator+(const DepthSums& a, const DepthSums& b) {
    return {a.x_ + b.x_, a.y_ + b.y_, a.z_ + b.z_, a.counts_ + b.counts_};
  }
  friend DepthSums operator-(const DepthSums& a, const DepthSums& b) {
    return {a.x_ - b.x_, a.y_ - b.y_, a.z_ - b.z_, a.counts_ - b.counts_};
  }

 private:
  // Two counters in one entry: points in the lower half, edges in the upper half.
  static constexpr uint32_t kOnePoint = 1;
  static constexpr uint32_t kOneEdge = 1u << 16;

  DepthSums(uint32_t x, uint32_t y, uint32_t z, uint32_t counts)
      : x_(x), y_(y), z_(z), counts_(counts) {}

  uint32_t x_ = 0, y_ = 0, z_ = 0, counts_ = 0;
};

}  // namespace msc_vo
