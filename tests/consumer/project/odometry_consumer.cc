// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Shows an odometry with custom factors and mapping in the gaps a black image: it must neither
// crash nor claim to have tracked anything.

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/odometry/odometry.h"

int main() {
  const msc_vo::PinholeCamera camera;
  msc_vo::OdometryOptions options;
  options.external_mapping = true;
  msc_vo::Odometry odometry(options, camera, msc_vo::LensDistortion());
  bool has_landmarks = false;
  odometry.SetWindowFactors([&](const msc_vo::WindowContext& window) {
    has_landmarks |= !window.data->points.empty();
    return msc_vo::WindowFactors();
  });
  odometry.SetPoseFactors(
      [](const msc_vo::FrameContext&) { return std::vector<msc_vo::PoseFactor>(); });
  msc_vo::RgbdImage image;
  image.gray = cv::Mat::zeros(camera.height, camera.width, CV_8UC1);
  image.depth = cv::Mat::zeros(camera.height, camera.width, CV_32FC1);
  const msc_vo::FrameResult result = odometry.Process(image);
  const bool is_idle = !odometry.RunMapping(0.01) && !has_landmarks;
  const bool has_one_frame = odometry.Finish().frames.size() == 1;
  return is_idle && has_one_frame && result.status != msc_vo::TrackingStatus::kTracked ? 0 : 1;
}
