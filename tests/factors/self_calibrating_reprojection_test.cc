// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/self_calibrating_reprojection.h"

#include "tests/factors/corrected_camera.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

// A point that a camera with a correction sees, as it measures it.
struct PointExample {
  explicit PointExample(unsigned seed) : random(seed) {
    correction = AnyCorrection(&random);
    cam_from_world = Rigid3(ExpSO3(0.2 * random.Normal3()), 0.2 * random.Normal3());
    const Eigen::Vector3d x{random.Uniform(-1.0, 1.0), random.Uniform(-0.7, 0.7), 3.0};
    point = cam_from_world.Inverse() * x;
    measurement.pixel =
        kCorrectedCamera.Pixel<double>(Eigen::Vector2d(x.head<2>() / x.z()), correction.data());
    measurement.sigma = 0.5;
    measurement.inverse_depth = 1.0 / x.z();
    measurement.inverse_depth_sigma = 0.01;
  }

  CostPtr Cost() const {
    return CostPtr(SelfCalibratingReprojection::Create(kCorrectedCamera, measurement));
  }
  std::vector<std::vector<double>> Blocks() const {
    return {Block(cam_from_world), Block(point),
            std::vector<double>(correction.data(), correction.data() + S::kColorSize)};
  }

  RandomGeometry random;
  S::Vector correction;
  Rigid3 cam_from_world;
  Eigen::Vector3d point;
  SelfCalibratingReprojection::Measurement measurement;
};

TEST(SelfCalibratingReprojection, IsZeroAtTheTruth) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const PointExample example(seed);
    EXPECT_THAT(Residual(*example.Cost(), example.Blocks()), IsNear(Eigen::Vector3d::Zero(), 1e-9));
  }
}

TEST(SelfCalibratingReprojection, IsWhitened) {
  PointExample example(6);
  example.measurement.pixel += Eigen::Vector2d(0.5, -1.0);
  example.measurement.inverse_depth += 0.01;
  EXPECT_THAT(Residual(*example.Cost(), example.Blocks()),
              IsNear(Eigen::Vector3d(-1.0, 2.0, -1.0), 1e-9));
}

TEST(SelfCalibratingReprojection, NeedsNoDepth) {
  PointExample example(7);
  example.measurement.inverse_depth = 0.0;
  example.point *= 1.1;
  EXPECT_EQ(Residual(*example.Cost(), example.Blocks())(2), 0.0);
}

TEST(SelfCalibratingReprojection, DerivativesMatch) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    PointExample example(seed);
    const CostPtr cost = example.Cost();
    example.correction = AnyCorrection(&example.random);
    ExpectGradientsMatch(*cost, example.Blocks());
  }
}

TEST(SelfCalibratingReprojection, IsUndefinedBehindTheCamera) {
  PointExample example(8);
  example.cam_from_world = Rigid3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, -9.0));
  EXPECT_FALSE(IsDefined(*example.Cost(), example.Blocks()));
}

}  // namespace
}  // namespace msc_vo
