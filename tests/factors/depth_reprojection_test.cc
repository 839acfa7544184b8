// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/depth_reprojection.h"

#include <cmath>

#include "tests/support/factor_checks.h"

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;

TEST(DepthReprojection, IsZeroAtTruth) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random.Pose();
    const Eigen::Vector3d x = random.InView();
    const CostPtr cost(DepthReprojection::Create(1.0 / x.z(), 0.002));
    EXPECT_THAT(Residual(*cost, {Block(pose), Block(pose.Inverse() * x)}),
                IsNear(Vector1(0.0), 1e-10));
  }
}

TEST(DepthReprojection, MatchesValueByHand) {
  // z = 1.5 + 0.5 = 2 m is 0.5 per metre; measured 0.49 with sigma 0.004.
  const CostPtr cost(DepthReprojection::Create(0.49, 0.004));
  const Rigid3 pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  EXPECT_THAT(Residual(*cost, {Block(pose), {0.2, -0.1, 0.5}}), IsNear(Vector1(2.5), 1e-12));
}

TEST(DepthReprojection, DerivativesMatch) {
  RandomGeometry random(2);
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random.Pose();
    const Blocks blocks{Block(pose), Block(pose.Inverse() * random.InView())};
    const DepthReprojection factor(0.4, 0.003);
    ExpectGradientsMatch(*CostPtr(DepthReprojection::Create(factor)), blocks);
    ExpectAnalyticMatchesAutomatic(factor, blocks);
  }
}

TEST(DepthReprojection, IsInvariantToMotionOfTheWorldAndLateralMotion) {
  RandomGeometry random(3);
  const Rigid3 pose = random.Pose(), shift = random.Pose();
  const Eigen::Vector3d in_cam = random.InView();
  const Eigen::Vector3d x = pose.Inverse() * in_cam;
  const CostPtr cost(DepthReprojection::Create(0.4, 0.003));
  const Eigen::VectorXd residual = Residual(*cost, {Block(pose), Block(x)});
  EXPECT_THAT(Residual(*cost, {Block(pose * shift.Inverse()), Block(shift * x)}),
              IsNear(residual, 1e-9));
  const Eigen::Vector3d across = pose.Inverse() * (in_cam + Eigen::Vector3d(0.3, -0.2, 0.0));
  EXPECT_THAT(Residual(*cost, {Block(pose), Block(across)}), IsNear(residual, 1e-9));
}

TEST(DepthReprojection, WeightOfAnErrorInMetresFallsWithDepth) {
  const auto residual_of_10_cm_at = [](double z) {
    const CostPtr cost(DepthReprojection::Create(1.0 / z, 0.002));
    return std::abs(Residual(*cost, {Block(Rigid3()), {0.0, 0.0, z + 0.1}})[0]);
  };
  // 1/z^2: a sixteenth at four times the distance, up to the curvature of 1/z over 10 cm.
  EXPECT_NEAR(residual_of_10_cm_at(2.0) / residual_of_10_cm_at(8.0), 16.0, 0.7);
}

TEST(DepthReprojection, HasUnitVarianceUnderItsNoise) {
  RandomGeometry random(4);
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const double measured = 0.5 + 0.003 * random.Normal();
    samples.push_back(Residual(*CostPtr(DepthReprojection::Create(measured, 0.003)),
                               {Block(Rigid3()), {0.1, 0.1, 2.0}}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(DepthReprojection, IsUndefinedBehindTheCamera) {
  const CostPtr cost(DepthReprojection::Create(0.4, 0.003));
  for (const double z : {-1.0, 0.0, 0.009}) {
    EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, z}})) << z;
  }
}

TEST(DepthReprojection, RecoversAPointFromThreeDirections) {
  const Eigen::Vector3d truth(0.3, -0.2, 0.4);
  Eigen::Vector3d x(0.5, 0.1, 0.1);
  // Cameras three metres away that look along the three axes.
  std::vector<Rigid3> poses;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d across = axis.cross(Eigen::Vector3d::UnitZ());
    poses.emplace_back(ExpSO3(0.5 * M_PI * across), Eigen::Vector3d(0.0, 0.0, 3.0));
  }
  ceres::Problem problem;
  for (Rigid3& pose : poses) {
    problem.AddResidualBlock(DepthReprojection::Create(1.0 / (pose * truth).z(), 0.002), nullptr,
                             pose.params.data(), x.data());
    problem.SetParameterBlockConstant(pose.params.data());
  }
  SolveToEnd(&problem);
  EXPECT_THAT(x, IsNear(truth, 1e-9));
}

}  // namespace
}  // namespace msc_vo
