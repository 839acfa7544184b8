// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The lens models against those of OpenCV.

#include <random>
#include <vector>

#include "tests/support/lenses.h"
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

// Points in front of the camera, within `radius` of the axis on the plane z = 1.
std::vector<cv::Point3d> Points(double radius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-radius, radius), depth(0.3, 8.0);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i) {
    const double z = depth(random);
    points.push_back({side(random) * z, side(random) * z, z});
  }
  return points;
}

cv::Matx33d Matrix(const PinholeCamera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

// Largest distance between the pixels of OpenCV and those of Distort(), which is given a pixel of
// the undistorted image.
double LargestDifference(const std::vector<cv::Point3d>& points,
                         const std::vector<cv::Point2d>& expected, const PinholeCamera& camera,
                         const LensDistortion& lens) {
  double largest = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d ideal = camera.Project({points[i].x, points[i].y, points[i].z});
    const Vector2d raw = lens.Distort(camera, ideal);
    largest = std::max(largest, (raw - Vector2d(expected[i].x, expected[i].y)).norm());
  }
  return largest;
}

TEST(LensModels, EqualOpenCvsProjectPoints) {
  const std::vector<cv::Point3d> points = Points(0.8);
  const PinholeCamera camera = AzureKinectCamera();
  const cv::Vec3d zero(0.0, 0.0, 0.0);
  for (const LensModel model : {LensModel::kRadialTangential, LensModel::kRational}) {
    LensDistortion lens = AzureKinectLens();
    lens.model = model;
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, zero, zero, Matrix(camera), lens.Coefficients(), expected);
    EXPECT_LT(LargestDifference(points, expected, camera, lens), 1e-9);
  }
}

TEST(LensModels, EqualOpenCvsFisheye) {
  const std::vector<cv::Point3d> points = Points(1.5);
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  const cv::Vec3d zero(0.0, 0.0, 0.0);
  std::vector<cv::Point2d> expected;
  cv::fisheye::projectPoints(points, expected, zero, zero, Matrix(camera), lens.Coefficients());
  EXPECT_LT(LargestDifference(points, expected, camera, lens), 1e-9);
  CropToFieldOfView(95.0, &lens, &camera);
  EXPECT_LT(LargestDifference(points, expected, camera, lens), 1e-9);
}

}  // namespace
}  // namespace msc_vo
