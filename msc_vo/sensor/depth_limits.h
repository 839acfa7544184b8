// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Measured depths are greater than `nearest` and less than `farthest`. Other values mean no
/// measurement.
struct DepthLimits {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  float nearest = 0.0f;
  float farthest = kInfinity;

  bool HasNearest() const { return nearest > 0.0f; }
  bool HasFarthest() const { return farthest < kInfinity; }
  bool Contain(float depth) const { return depth > nearest && depth < farthest; }
  /// Sets the values of a depth image of one channel that are no measurements to 0.
  void Apply(cv::Mat* depth) const {
    if (HasNearest()) depth->setTo(0, *depth <= nearest);
    if (HasFarthest()) depth->setTo(0, *depth >= farthest);
  }
};

/// Whether images with this median depth, metres, can be of an RGB-D camera: otherwise no feature
/// has a usable depth, and the unit of the values is another one.
inline bool IsUsableDepth(double median) { return median >= 0.1 && median <= 40.0; }

}  // namespace msc_vo
