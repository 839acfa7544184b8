// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>

#include "tests/support/eigen_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

Calibration Given() {
  Calibration calibration;
  calibration.camera = {500.0, 510.0, 320.0, 240.0, 640, 480};
  return calibration;
}

S::Vector AllCorrections() {
  S::Vector correction = S::Vector::Zero();
  correction(S::kFocalLength) = 0.03;
  correction(S::kCenterX) = 0.008;
  correction(S::kCenterY) = -0.006;
  correction(S::kDepthFocalLength) = 0.1;
  correction(S::kDepthX) = 0.01;
  correction(S::kDepthY) = -0.012;
  correction(S::kDepthParallaxX) = -0.025;
  correction(S::kDepthParallaxY) = 0.01;
  return correction;
}

// Pixel of the depth camera that sees the point at ray x (z = 1) and inverse depth w.
Eigen::Vector2d DepthPixel(const DepthCamera& depth_camera, const Eigen::Vector2d& x, double w) {
  const Eigen::Vector3d point(x.x() / w, x.y() / w, 1.0 / w);
  return depth_camera.camera.Project(depth_camera.depth_from_color * point);
}

TEST(CalibrationCorrection, ZeroChangesNothing) {
  const Calibration corrected = Corrected(Given(), S::Vector::Zero());
  EXPECT_EQ(corrected.camera.fx, 500.0);
  EXPECT_EQ(corrected.camera.cx, 320.0);
  EXPECT_FALSE(corrected.depth_camera);
}

TEST(CalibrationCorrection, ColourCorrectionsLeaveTheRegistrationAsItIs) {
  S::Vector correction = S::Vector::Zero();
  correction(S::kFocalLength) = 0.03;
  correction(S::kK1) = -0.1;
  const Calibration corrected = Corrected(Given(), correction);
  EXPECT_NEAR(corrected.camera.fx, 500.0 * std::exp(0.03), 1e-9);
  EXPECT_NEAR(corrected.camera.fy, 510.0 * std::exp(0.03), 1e-9);
  EXPECT_EQ(corrected.distortion.k[0], -0.1);
  EXPECT_FALSE(corrected.depth_camera);
}

TEST(CalibrationCorrection, DepthCameraReadsThePixelsOfTheCorrection) {
  const S::Vector correction = AllCorrections();
  const CorrectedCamera camera(Given().camera, LensDistortion());
  const Calibration corrected = Corrected(Given(), correction);
  ASSERT_TRUE(corrected.depth_camera);
  for (const double w : {0.2, 1.0}) {
    for (const Eigen::Vector2d& x : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.4, -0.3)}) {
      const Eigen::Vector2d pixel = camera.Pixel<double>(x, correction.data());
      Eigen::Vector2d at_infinity, parallax;
      camera.DepthPixel(pixel, correction.data(), &at_infinity, &parallax);
      EXPECT_THAT(DepthPixel(*corrected.depth_camera, x, w),
                  IsNear(Eigen::Vector2d(at_infinity + w * parallax), 1e-6));
    }
  }
}

TEST(CalibrationCorrection, RefinesADepthCamera) {
  Calibration given = Given();
  DepthCamera depth_camera;
  depth_camera.camera = {585.0, 585.0, 325.0, 235.0, 640, 480};
  depth_camera.depth_from_color =
      Rigid3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.025, 0.0, 0.0));
  given.depth_camera = depth_camera;
  const S::Vector correction = AllCorrections();
  const CorrectedCamera camera(given.camera, LensDistortion());
  const Calibration corrected = Corrected(given, correction);
  const Eigen::Vector2d x(0.3, 0.2);
  const double w = 0.5;
  Eigen::Vector2d at_infinity, parallax;
  camera.DepthPixel(camera.Pixel<double>(x, correction.data()), correction.data(), &at_infinity,
                    &parallax);
  // The given depth camera registers its images to the given colour camera.
  const Eigen::Vector2d registered = at_infinity + w * parallax;
  const Eigen::Vector2d read = DepthPixel(depth_camera, given.camera.Ray(registered).head<2>(), w);
  EXPECT_THAT(DepthPixel(*corrected.depth_camera, x, w), IsNear(read, 1e-6));
}

}  // namespace
}  // namespace msc_vo
