// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/standalone_image.h"

#include <functional>
#include <string>

#include "tests/support/image_views.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/depth_alignment.h"
#include "msc_vo/sensor/depth_bleeding.h"
#include "msc_vo/sensor/depth_edges.h"
#include "msc_vo/sensor/depth_registration.h"
#include "msc_vo/sensor/depth_sensor.h"
#include "msc_vo/sensor/flying_pixels.h"
#include "msc_vo/sensor/lens_remap.h"
#include "msc_vo/sensor/recorded_image.h"

namespace msc_vo {
namespace {

const PinholeCamera kCamera = {90.0, 90.0, 79.5, 59.5, 160, 120};

// Smooth noise, so that edges reach the borders.
cv::Mat Gray() {
  cv::Mat gray(kCamera.height, kCamera.width, CV_8UC1);
  cv::RNG(3).fill(gray, cv::RNG::UNIFORM, 0, 255);
  cv::blur(gray, gray, {3, 3});
  return gray;
}

// Boxes in front of a wall, some of them cut by the border.
cv::Mat Depth() {
  cv::Mat depth(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(3.1));
  for (const cv::Rect box : {cv::Rect(0, 0, 40, 50), {60, 30, 30, 90}, {120, 70, 40, 30}}) {
    depth(box).setTo(1.3 + 0.01 * box.x);
  }
  return depth;
}

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(StandaloneImage, SharesWhatStandsAloneAndCopiesViews) {
  const cv::Mat gray = Gray();
  EXPECT_EQ(StandaloneImage(gray).data, gray.data);
  for (const cv::Mat& view : ViewsOf(gray)) {
    const cv::Mat copy = StandaloneImage(view);
    EXPECT_FALSE(copy.isSubmatrix());
    EXPECT_TRUE(copy.isContinuous());
    EXPECT_NE(copy.data, view.data);
    EXPECT_TRUE(AreSame(copy, gray));
  }
  EXPECT_TRUE(StandaloneImage(cv::Mat()).empty());
}

// Every function of sensor/ that takes an image, as a function of grey and depth.
struct NamedFunction {
  std::string name;
  std::function<cv::Mat(const cv::Mat& gray, const cv::Mat& depth)> call;
};

std::vector<NamedFunction> Functions() {
  const LensDistortion lens{{0.1, -0.05, 0.001, 0.0, 0.0}};
  const auto reach = [](const cv::Mat& gray, const cv::Mat& depth) {
    BleedingEstimator estimator(kCamera.width);
    estimator.Add(gray, depth);
    return cv::Mat(1, 1, CV_32SC1, cv::Scalar(estimator.reach()));
  };
  return {
      {"GradientsOf, rows",
       [](const cv::Mat& gray, const cv::Mat&) { return GradientsOf(gray).along_rows; }},
      {"GradientsOf, columns",
       [](const cv::Mat& gray, const cv::Mat&) { return GradientsOf(gray).along_columns; }},
      {"Reduce",
       [](const cv::Mat& gray, const cv::Mat& depth) { return Reduce(gray, depth).gray; }},
      {"RemoveBleeding",
       [](const cv::Mat&, const cv::Mat& depth) { return RemoveBleeding(depth, 3, 0.001); }},
      {"BleedingEstimator", reach},
      {"RemoveFlyingPixels",
       [](const cv::Mat&, const cv::Mat& depth) {
         return RemoveFlyingPixels(
             depth, MakeDepthSensorModel(DepthSensor::kTimeOfFlight, {}, kCamera.width).noise);
       }},
      {"Undistort", [lens](const cv::Mat& gray,
                           const cv::Mat&) { return LensRemap(kCamera, lens).Undistort(gray); }},
      {"AlignDepth",
       [](const cv::Mat&, const cv::Mat& depth) {
         return AlignDepth(kCamera, depth,
                           Rigid3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.05, 0.0, 0.0)));
       }},
      {"DepthRegistration",
       [](const cv::Mat&, const cv::Mat& depth) {
         DepthCamera depth_camera;
         depth_camera.camera = kCamera;
         depth_camera.depth_from_color.translation().x() = 0.025;
         return DepthRegistration(depth_camera, kCamera, {}).Register(depth);
       }},
      {"RecordedImage", [](const cv::Mat& gray, const cv::Mat& depth) {
         return RecordedImage(gray, depth, DepthSensor::kStructuredLight).Depth();
       }}};
}

TEST(StandaloneImage, ViewsGiveTheBitsOfCopies) {
  const cv::Mat gray = Gray(), depth = Depth();
  const std::vector<cv::Mat> gray_views = ViewsOf(gray), depth_views = ViewsOf(depth);
  for (const NamedFunction& function : Functions()) {
    const cv::Mat expected = function.call(gray, depth);
    for (size_t i = 0; i < gray_views.size(); ++i) {
      EXPECT_TRUE(AreSame(function.call(gray_views[i], depth_views[i]), expected))
          << function.name << ", view " << i;
    }
  }
}

}  // namespace
}  // namespace msc_vo
