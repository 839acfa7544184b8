// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo::testing {

// A camera without a lens.
inline const PinholeCamera kVgaCamera{480.0, 480.0, 319.5, 239.5, 640, 480};

// Renders a depth image (CV_32FC1, metres) without lens distortion from a function of the pixel
// that returns the inverse depth (1/metres; 0: no depth).
template <typename Function>
cv::Mat DrawDepth(const PinholeCamera& camera, const Function& inverse_depth_at) {
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double w = inverse_depth_at(Eigen::Vector2d(x, y));
      depth.at<float>(y, x) = w > 0.0 ? static_cast<float>(1.0 / w) : 0.0f;
    }
  }
  return depth;
}

// Adds noise of standard deviation `sigma` (1/metres) to the inverse depth: white if `blur` is 0,
// otherwise correlated by a Gaussian of `blur` pixels.
inline void AddInverseDepthNoise(double sigma, double blur, uint32_t seed, cv::Mat* depth) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  cv::Mat noise(depth->size(), CV_32FC1);
  for (int y = 0; y < noise.rows; ++y) {
    for (int x = 0; x < noise.cols; ++x) noise.at<float>(y, x) = static_cast<float>(normal(random));
  }
  if (blur > 0.0) {
    cv::GaussianBlur(noise, noise, cv::Size(), blur);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(noise, mean, deviation);
    noise /= deviation[0];
  }
  for (int y = 0; y < noise.rows; ++y) {
    for (int x = 0; x < noise.cols; ++x) {
      float& z = depth->at<float>(y, x);
      if (z > 0.0f) z = static_cast<float>(1.0 / (1.0 / z + sigma * noise.at<float>(y, x)));
    }
  }
}

}  // namespace msc_vo::testing
