// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/lens_remap.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace msc_vo {

cv::Mat UndistortedPixels(const PinholeCamera& camera, const LensDistortion& distortion) {
  cv::Mat ideal(camera.height, camera.width, CV_32FC2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d pixel = distortion.Undistort(camera, {x, y});
      ideal.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  return ideal;
}

double LargestStretch(const PinholeCamera& camera, const LensDistortion& lens) {
  constexpr int kSteps = 32;
  double largest = 1.0;
  if (lens.model == LensModel::kRadialTangential && !lens.recorded) return 1.0;
  const double zoom = lens.Recorded(camera).FocalLength() / camera.FocalLength();
  for (int i = 0; i <= kSteps * kSteps + 2 * kSteps; ++i) {
    const Eigen::Vector2d pixel(camera.width * (i % (kSteps + 1)) / kSteps,
                                camera.height * (i / (kSteps + 1)) / kSteps);
    largest = std::max(largest, zoom * lens.Jacobian(camera.Ray(pixel).head<2>()).norm());
  }
  return largest;
}

LensRemap::LensRemap(const PinholeCamera& camera, const LensDistortion& distortion)
    : camera_(camera), distortion_(distortion) {
  if (distortion.IsZero()) return;
  cv::Mat raw_pixels(camera.height, camera.width, CV_32FC2);
  mask_ = cv::Mat::zeros(camera.height, camera.width, CV_8UC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d raw = distortion.Distort(camera, {x, y});
      raw_pixels.at<cv::Vec2f>(y, x) = {static_cast<float>(raw.x()), static_cast<float>(raw.y())};
      if (distortion.Recorded(camera).IsInside(raw)) mask_.at<uint8_t>(y, x) = 255;
    }
  }
  cv::convertMaps(raw_pixels, cv::noArray(), map_, fraction_, CV_16SC2);
}

double LensRemap::Magnification(const Eigen::Vector2d& ideal_pixel) const {
  if (distortion_.IsZero()) return 1.0;
  const PinholeCamera& raw = distortion_.Recorded(camera_);
  const Eigen::Matrix2d jacobian = distortion_.Jacobian(camera_.Ray(ideal_pixel).head<2>());
  return std::abs(camera_.fx * camera_.fy / (raw.fx * raw.fy * jacobian.determinant()));
}

cv::Mat LensRemap::Undistort(const cv::Mat& raw) const {
  if (distortion_.IsZero()) return raw;
  // Replication avoids an artificial edge at the border; the mask excludes the replicated pixels.
  cv::Mat ideal;
  cv::remap(raw, ideal, map_, fraction_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return ideal;
}

}  // namespace msc_vo
