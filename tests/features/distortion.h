// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo::testing {

// Camera fr1 of the TUM RGB-D benchmark, which has the strongest distortion.
inline PinholeCamera Freiburg1Camera() { return {517.3, 516.5, 318.6, 255.3, 640, 480}; }
inline LensDistortion Freiburg1Distortion() {
  LensDistortion distortion;
  distortion.k = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return distortion;
}

// Applies the lens distortion to an undistorted image (of any type that cv::remap supports).
inline cv::Mat DistortImage(const PinholeCamera& camera, const LensDistortion& distortion,
                            const cv::Mat& ideal, int interpolation = cv::INTER_CUBIC) {
  cv::Mat ideal_pixels(camera.height, camera.width, CV_32FC2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d pixel = distortion.Undistort(camera, {x, y});
      ideal_pixels.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()),
                                          static_cast<float>(pixel.y())};
    }
  }
  cv::Mat raw;
  cv::remap(ideal, raw, ideal_pixels, cv::noArray(), interpolation, cv::BORDER_REPLICATE);
  return raw;
}

}  // namespace msc_vo::testing
