// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/common_camera.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace msc_vo {
namespace {

PinholeCamera CameraOf(double focal) { return {focal, focal, 639.5, 479.5, 1280, 960}; }

TEST(CommonCamera, LeavesSmallChangesAlone) {
  // A corner is 800 pixels from the centre.
  const CommonCamera camera({CameraOf(1000.0), CameraOf(1000.2), CameraOf(1010.0)});
  EXPECT_EQ(camera.camera().fx, 1000.2);
  EXPECT_FALSE(camera.Resamples(0));
  EXPECT_FALSE(camera.Resamples(1));
  EXPECT_TRUE(camera.Resamples(2));
  EXPECT_EQ(camera.num_resampled(), 1);
  EXPECT_NEAR(camera.largest_displacement(), 7.8, 0.1);
}

TEST(CommonCamera, MovesPixelsToWhereTheCommonCameraSeesThem) {
  std::vector<PinholeCamera> cameras(3, CameraOf(1000.0));
  cameras[0].fx = 1020.0;
  cameras[0].cx += 4.0;
  const CommonCamera camera(cameras);
  // A point that the first camera sees at a pixel of its image, and at a quarter of the size.
  const Eigen::Vector3d ray = cameras[0].Ray({1000.0, 700.0});
  const Eigen::Vector2d expected = camera.camera().Project(ray);
  for (const int step : {1, 4}) {
    cv::Mat image = cv::Mat::zeros(960 / step, 1280 / step, CV_32FC1);
    for (int dy = -8; dy <= 8; ++dy) {
      for (int dx = -8; dx <= 8; ++dx) {
        const double x = (1000.5 / step - 0.5), y = (700.5 / step - 0.5);
        const int u = cvRound(x) + dx, v = cvRound(y) + dy;
        image.at<float>(v, u) =
            static_cast<float>(std::exp(-0.25 * ((u - x) * (u - x) + (v - y) * (v - y))));
      }
    }
    const cv::Moments m = cv::moments(camera.Resample(0, image, cv::INTER_LINEAR));
    EXPECT_NEAR((m.m10 / m.m00 + 0.5) * step - 0.5, expected.x(), 0.1 * step);
    EXPECT_NEAR((m.m01 / m.m00 + 0.5) * step - 0.5, expected.y(), 0.1 * step);
  }
}

}  // namespace
}  // namespace msc_vo
