// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// Largest difference of inverse depths on one surface, 1/metres. Two pixels lie on one surface if
/// their inverse depths differ by less than a ratio of their value (a plane seen at 87 degrees
/// changes by as much from pixel to pixel), or by less than the noise of a sensor.
inline float EdgeThreshold(float inverse_depth) {
  constexpr float kMaxRatio = 0.04f;
  constexpr float kMaxNoise = 0.006f;  // 1/metres
  return std::max(kMaxRatio * inverse_depth, kMaxNoise);
}

/// The colour image that a DepthRegistration draws into: inverse depths with a border, so that no
/// pixel needs a test.
class RegistrationTarget {
 public:
  RegistrationTarget(const PinholeCamera& color, int radius)
      : radius_(radius),
        inverse_depth_(
            cv::Mat::zeros(color.height + 2 * radius, color.width + 2 * radius, CV_32FC1)),
        distance_(color.height, color.width, CV_32FC1) {}

  /// Offers an inverse depth to pixel (x, y). The nearest surface wins; on one surface, the depth
  /// pixel whose centre is nearest, at `distance` in depth pixels.
  void Offer(int x, int y, float inverse_depth, float distance) {
    float& best = inverse_depth_.ptr<float>(y + radius_)[x + radius_];
    float& best_distance = distance_.ptr<float>(y)[x];
    const float threshold = EdgeThreshold(best);
    if (best > 0.0f && inverse_depth <= best + threshold &&
        (inverse_depth < best - threshold || distance >= best_distance)) {
      return;
    }
    best = inverse_depth;
    best_distance = distance;
  }

  /// Depths, without those of pixels between nearer pixels of one surface.
  cv::Mat Depth() const;

 private:
  int width() const { return distance_.cols; }
  int height() const { return distance_.rows; }
  void FindNearest(int y, int step_y, int step_x, std::vector<float>* nearest) const;
  void WriteRow(const std::vector<float> (&sides)[4], const float* inverse_depth,
                float* depth) const;

  int radius_;
  cv::Mat inverse_depth_;  // 1/metres, 0: none
  cv::Mat distance_;       // valid where there is an inverse depth
};

}  // namespace msc_vo
