// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/linearized_camera.h"

#include "tests/factors/corrected_camera.h"
#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Jet = ceres::Jet<double, SensorCorrection::kSize>;
using JetCorrection = Eigen::Matrix<Jet, SensorCorrection::kSize, 1>;
using JetVector = Eigen::Matrix<Jet, 2, 1>;

constexpr int kColorSize = LinearizedCamera::kColorSize;
constexpr int kDepthSize = LinearizedCamera::kDepthSize;

JetCorrection Parameters(const SensorCorrection::Vector& correction) {
  JetCorrection jets;
  for (int i = 0; i < SensorCorrection::kSize; ++i) jets(i) = Jet(correction(i), i);
  return jets;
}

void ExpectSame(const JetVector& expected, const Eigen::Vector2d& value,
                const LinearizedCamera::ColorJacobian& jacobian) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(expected(i).a, value(i), 1e-8);
    const Eigen::RowVectorXd row = expected(i).v.transpose().head<kColorSize>();
    EXPECT_LT((row - jacobian.row(i)).norm(), 1e-6 * (1.0 + row.norm()));
  }
}

class LinearizedCameraTest : public testing::TestWithParam<LensModel> {
 protected:
  static CorrectedCamera Camera() {
    LensDistortion lens{{0.05, -0.02, 0.001, -0.001, 0.01}};
    lens.model = GetParam();
    if (GetParam() == LensModel::kFisheye) lens.k = {0.05, -0.02, 0.01, -0.001};
    return {kCorrectedCamera.camera(), lens};
  }
};

TEST_P(LinearizedCameraTest, ColourCameraAndDerivativesMatch) {
  RandomGeometry random(1);
  const CorrectedCamera camera = Camera();
  for (int i = 0; i < 5; ++i) {
    const SensorCorrection::Vector correction = AnyCorrection(&random);
    const JetCorrection jets = Parameters(correction);
    const LinearizedCamera linearized(camera, correction);
    const Eigen::Vector2d pixel(random.Uniform(0.0, 640.0), random.Uniform(0.0, 480.0));
    const Eigen::Vector2d x = linearized.Ray(pixel);
    ExpectSame(camera.Ray<Jet>(pixel, jets.data()), x, linearized.RayByCamera(x));
    ExpectSame(camera.Pixel<Jet>(x.cast<Jet>(), jets.data()), linearized.Pixel(x),
               linearized.PixelByCamera(x));
    const Eigen::Vector2d step = 1e-6 * random.Normal2();
    EXPECT_LT((linearized.Pixel(x + step) - linearized.Pixel(x - step) -
               2.0 * linearized.PixelByPoint(x) * step)
                  .norm(),
              1e-5 * step.norm() * kCorrectedCamera.camera().fx);
  }
}

TEST_P(LinearizedCameraTest, InverseDepthAndDerivativesMatch) {
  RandomGeometry random(2);
  const CorrectedCamera camera = Camera();
  for (int i = 0; i < 5; ++i) {
    const SensorCorrection::Vector correction = AnyCorrection(&random);
    RgbdPairReprojection::View view;
    view.recorded_pixel = {random.Uniform(0.0, 640.0), random.Uniform(0.0, 480.0)};
    view.pixel = view.recorded_pixel;
    view.surface = {view.recorded_pixel + 3.0 * random.Normal2(), 0.5, 1e-3 * random.Normal2()};
    const RgbdPairReprojection factor(camera, view, view, Eigen::Matrix3d::Identity());
    const Jet expected = factor.InverseDepth<Jet>(view, Parameters(correction).data());
    LinearizedCamera::DepthJacobian jacobian;
    EXPECT_NEAR(expected.a, LinearizedCamera(camera, correction).InverseDepth(view, &jacobian),
                1e-12);
    EXPECT_LT((expected.v.transpose().tail<kDepthSize>() - jacobian).norm(), 1e-10);
    EXPECT_EQ((expected.v.head<kColorSize>()).norm(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(LensModels, LinearizedCameraTest,
                         testing::Values(LensModel::kRadialTangential, LensModel::kRational,
                                         LensModel::kFisheye));

}  // namespace
}  // namespace msc_vo
