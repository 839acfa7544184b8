// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/eigen_matchers.h"
#include "tests/support/lenses.h"
#include <Eigen/Geometry>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;
using S = SensorCorrection;
using Jet = ceres::Jet<double, S::kSize>;

CorrectedCamera Fisheye() {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView({}, &lens, &camera);
  return {camera, lens};
}

S::Vector AnyCorrection() {
  S::Vector correction = S::Vector::Zero();
  correction(S::kFocalLength) = 0.02;
  correction(S::kCenterX) = 0.006;
  correction(S::kCenterY) = -0.004;
  correction(S::kK1) = 0.01;
  correction(S::kK2) = -0.005;
  return correction;
}

class CorrectedCameraTest : public ::testing::TestWithParam<CorrectedCamera> {};

TEST_P(CorrectedCameraTest, RayInvertsPixel) {
  const CorrectedCamera& camera = GetParam();
  const S::Vector correction = AnyCorrection();
  for (const Vector2d& x : {Vector2d(0.0, 0.0), Vector2d(0.4, -0.3), Vector2d(-0.8, 0.5)}) {
    const Vector2d pixel = camera.Pixel<double>(x, correction.data());
    EXPECT_THAT(camera.Ray<double>(pixel, correction.data()), IsNear(x, 1e-10));
  }
}

TEST_P(CorrectedCameraTest, ZeroCorrectionIsTheLens) {
  const CorrectedCamera& camera = GetParam();
  const S::Vector none = S::Vector::Zero();
  const Vector2d x(0.5, 0.3);
  const Vector2d distorted = camera.distortion().DistortNormalized(x);
  EXPECT_THAT(camera.Pixel<double>(x, none.data()),
              IsNear(Vector2d(camera.camera().Project(distorted.homogeneous())), 1e-10));
}

TEST_P(CorrectedCameraTest, DerivativesMatchFiniteDifferences) {
  const CorrectedCamera& camera = GetParam();
  const S::Vector at = AnyCorrection();
  Jet jets[S::kSize];
  for (int i = 0; i < S::kSize; ++i) jets[i] = Jet(at(i), i);
  const Vector2d pixel(500.0, 130.0), x(0.6, -0.4);
  const auto ray = camera.Ray<Jet>(pixel, jets);
  const auto projected = camera.Pixel<Jet>(Eigen::Matrix<Jet, 2, 1>(Jet(x.x()), Jet(x.y())), jets);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < S::kSize; ++i) {
    S::Vector low = at, high = at;
    low(i) -= kStep;
    high(i) += kStep;
    const Vector2d by_ray =
        (camera.Ray<double>(pixel, high.data()) - camera.Ray<double>(pixel, low.data())) /
        (2.0 * kStep);
    const Vector2d by_pixel =
        (camera.Pixel<double>(x, high.data()) - camera.Pixel<double>(x, low.data())) /
        (2.0 * kStep);
    EXPECT_THAT(Vector2d(ray.x().v(i), ray.y().v(i)), IsNear(by_ray, 1e-7)) << i;
    EXPECT_THAT(Vector2d(projected.x().v(i), projected.y().v(i)), IsNear(by_pixel, 1e-5)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, CorrectedCameraTest,
                         ::testing::Values(CorrectedCamera(AzureKinectCamera(), AzureKinectLens()),
                                           Fisheye()));

}  // namespace
}  // namespace msc_vo
