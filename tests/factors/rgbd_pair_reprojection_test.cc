// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/rgbd_pair_reprojection.h"

#include "tests/factors/corrected_camera.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

// The view of `x` (camera frame, metres) on a plane with a random slope, as the camera with the
// correction records it.
RgbdPairReprojection::View ViewOf(const Eigen::Vector3d& x, const S::Vector& correction,
                                  RandomGeometry* random) {
  RgbdPairReprojection::View view;
  view.pixel =
      kCorrectedCamera.Pixel<double>(Eigen::Vector2d(x.head<2>() / x.z()), correction.data());
  view.recorded_pixel = view.pixel;
  // The inverse depth that the sensor measures.
  const double r2 = kCorrectedCamera.camera().Ray(view.pixel).head<2>().squaredNorm();
  const double measured =
      (1.0 / x.z() + correction(S::kDepthOffset)) / (1.0 - r2 * correction(S::kDepthBowl));
  Eigen::Vector2d at_infinity, parallax;
  kCorrectedCamera.DepthPixel(view.pixel, correction.data(), &at_infinity, &parallax);
  const Eigen::Vector2d true_pixel = at_infinity + measured * parallax;
  view.surface.gradient = 1e-3 * random->Normal2();
  view.surface.pixel = true_pixel + 2.0 * random->Normal2();
  view.surface.inverse_depth =
      measured + view.surface.gradient.dot(view.surface.pixel - true_pixel);
  return view;
}

struct PairExample {
  explicit PairExample(unsigned seed) : random(seed) {
    correction = AnyCorrection(&random);
    b_from_a = Rigid3(ExpSO3(0.2 * random.Normal3()), 0.2 * random.Normal3());
    const Eigen::Vector3d in_a{random.Uniform(-1.0, 1.0), random.Uniform(-0.7, 0.7), 3.0};
    a = ViewOf(in_a, correction, &random);
    b = ViewOf(b_from_a * in_a, correction, &random);
  }

  RandomGeometry random;
  S::Vector correction;
  Rigid3 b_from_a;
  RgbdPairReprojection::View a, b;
};

TEST(RgbdPairReprojection, IsZeroAtTheTruth) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const PairExample example(seed);
    const CostPtr cost(RgbdPairReprojection::Create(kCorrectedCamera, example.a, example.b,
                                                    Eigen::Matrix3d::Identity()));
    EXPECT_THAT(Residual(*cost, {Block(example.b_from_a), CorrectionBlock(example.correction)}),
                IsNear(Eigen::Vector3d::Zero(), 1e-6));
  }
}

TEST(RgbdPairReprojection, DependsOnEveryParameter) {
  const PairExample example(6);
  const CostPtr cost(RgbdPairReprojection::Create(kCorrectedCamera, example.a, example.b,
                                                  Eigen::Matrix3d::Identity()));
  const Linearization at =
      Linearize(*cost, {Block(example.b_from_a), CorrectionBlock(example.correction)});
  for (int i = 0; i < S::kSize; ++i) EXPECT_GT(at.jacobians[1].col(i).norm(), 0.0) << i;
}

TEST(RgbdPairReprojection, DerivativesMatch) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    PairExample example(seed);
    const Eigen::Matrix3d weight = Eigen::Vector3d(2.0, 2.0, 250.0).asDiagonal();
    const CostPtr cost(
        RgbdPairReprojection::Create(kCorrectedCamera, example.a, example.b, weight));
    ExpectGradientsMatch(
        *cost, {Block(example.b_from_a), CorrectionBlock(AnyCorrection(&example.random))});
  }
}

TEST(RgbdPairReprojection, IsUndefinedBehindTheCamera) {
  const PairExample example(7);
  const CostPtr cost(RgbdPairReprojection::Create(kCorrectedCamera, example.a, example.b,
                                                  Eigen::Matrix3d::Identity()));
  const Rigid3 behind(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, -5.0));
  EXPECT_FALSE(IsDefined(*cost, {Block(behind), CorrectionBlock(example.correction)}));
}

TEST(CorrectedCamera, RayIsTheInverseOfPixel) {
  RandomGeometry random(8);
  for (int i = 0; i < 20; ++i) {
    const S::Vector correction = AnyCorrection(&random);
    const Eigen::Vector2d x{random.Uniform(-0.5, 0.5), random.Uniform(-0.4, 0.4)};
    const Eigen::Vector2d pixel = kCorrectedCamera.Pixel<double>(x, correction.data());
    EXPECT_THAT(kCorrectedCamera.Ray<double>(pixel, correction.data()), IsNear(x, 1e-6));
  }
}

}  // namespace
}  // namespace msc_vo
