// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/lens_remap.h"

#include <opencv2/imgproc.hpp>

namespace msc_vo {

LensRemap::LensRemap(const PinholeCamera& camera, const LensDistortion& distortion)
    : camera_(camera), distortion_(distortion) {
  if (distortion.IsZero()) return;
  cv::Mat raw_pixels(camera.height, camera.width, CV_32FC2);
  mask_ = cv::Mat::zeros(camera.height, camera.width, CV_8UC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d raw = distortion.Distort(camera, {x, y});
      raw_pixels.at<cv::Vec2f>(y, x) = {static_cast<float>(raw.x()), static_cast<float>(raw.y())};
      if (camera.IsInside(raw)) mask_.at<uint8_t>(y, x) = 255;
    }
  }
  cv::convertMaps(raw_pixels, cv::noArray(), map_, fraction_, CV_16SC2);
}

cv::Mat LensRemap::Undistort(const cv::Mat& raw) const {
  if (distortion_.IsZero()) return raw;
  // Replication avoids an artificial edge at the border; the mask excludes the replicated pixels.
  cv::Mat ideal;
  cv::remap(raw, ideal, map_, fraction_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return ideal;
}

}  // namespace msc_vo
