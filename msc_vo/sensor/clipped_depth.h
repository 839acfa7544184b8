// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/depth_limits.h"

namespace msc_vo {

/// Finds the value that a driver gives to every depth beyond the largest one, or to every depth
/// below the smallest one. Such a value fills areas of the images and stays the extreme one while
/// the depths of the scene change. A real surface, also one whose depth is rounded coarsely, gets
/// other values as soon as the camera moves by two steps of the rounding.
class ClippedDepthFinder {
 public:
  ClippedDepthFinder() = default;
  /// `limits`: those known already.
  explicit ClippedDepthFinder(const DepthLimits& limits) : limits_(limits) {}

  /// Adds the next depth image of a sequence, or of a sample of it in order of time: CV_32FC1, in
  /// any unit, 0 where nothing was measured. Returns whether limits() have changed.
  bool Add(const cv::Mat& depth);

  /// What the images so far have shown. Values outside the limits do not count as measured.
  const DepthLimits& limits() const { return limits_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [limits, farthest, nearest] = *this;  // all members, or it does not compile
    archive(limits, farthest, nearest);
  }

 private:
  /// One end of the range of depths.
  struct Evidence {
    float value = 0.0f;             // the extreme one so far; 0: none
    int num_clipped = 0;            // images with areas of this value
    int num_others = 0;             // images that end at a similar value, or have few of this one
    int num_moved = 0;              // clipped images between which the scene has moved
    std::vector<float> last_moved;  // samples of the last one of these
  };

  // `sign`: 1 for the largest depth, -1 for the smallest one. Returns whether the evidence
  // suffices.
  static bool AddEvidence(const cv::Mat& depth, const std::vector<float>& samples, int sign,
                          Evidence* evidence);

  DepthLimits limits_;
  Evidence farthest_;
  Evidence nearest_;
};

}  // namespace msc_vo
