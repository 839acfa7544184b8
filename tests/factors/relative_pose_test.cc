// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/relative_pose.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

using Matrix6d = RelativePose::Matrix6d;

const Eigen::VectorXd kZero = Eigen::VectorXd::Zero(6);

// Full covariance with correlations between rotation and translation.
Matrix6d CorrelatedCovariance(RandomGeometry* random) {
  Matrix6d factor;
  for (int i = 0; i < 36; ++i) factor.data()[i] = 0.05 * random->Normal();
  return factor * factor.transpose() + 1e-3 * Matrix6d::Identity();
}

Rigid3 Scaled(const Rigid3& pose, double scale) {
  return {Eigen::Quaterniond(pose.rotation()), scale * pose.translation()};
}

TEST(RelativePose, IsZeroAtTheTruth) {
  RandomGeometry random(1);
  const Rigid3 a = random.Pose(), b_from_a = random.Pose();
  const CostPtr cost(RelativePose::Create(b_from_a, CorrelatedCovariance(&random)));
  EXPECT_THAT(Residual(*cost, {Block(a), Block(b_from_a * a)}), IsNear(kZero, 1e-9));
}

TEST(RelativePose, MatchesValueByHand) {
  // Camera b is 1 m in front of camera a. Measured: 0.8 m and a turn of 0.1 rad about z.
  const Rigid3 a, b(Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.0});
  const Rigid3 measured(ExpSO3({0.0, 0.0, 0.1}), {0.0, 0.0, -0.8});
  Matrix6d covariance = Matrix6d::Identity();
  covariance.diagonal() << 0.04, 0.04, 0.04, 0.01, 0.01, 0.01;
  Eigen::VectorXd expected(6);
  expected << 0.0, 0.0, -0.5, 0.0, 0.0, -2.0;
  const CostPtr cost(RelativePose::Create(measured, covariance));
  EXPECT_THAT(Residual(*cost, {Block(a), Block(b)}), IsNear(expected, 1e-12));
}

TEST(RelativePose, DoesNotDependOnTheWorldFrame) {
  RandomGeometry random(2);
  const Rigid3 a = random.Pose(), b = random.Pose(), world = random.Pose();
  const CostPtr cost(RelativePose::Create(random.Pose(), CorrelatedCovariance(&random)));
  EXPECT_THAT(Residual(*cost, {Block(a * world), Block(b * world)}),
              IsNear(Residual(*cost, {Block(a), Block(b)}), 1e-9));
}

TEST(RelativePose, DerivativesMatch) {
  RandomGeometry random(3);
  for (const double distance : {0.0, 1e-3, 0.5, 2.0}) {
    const Rigid3 a = random.Pose(), b_from_a = random.Pose();
    const Eigen::Vector3d w = distance * random.Normal3().normalized(), u = random.Normal3();
    ExpectGradientsMatch(*CostPtr(RelativePose::Create(b_from_a, CorrelatedCovariance(&random))),
                         {Block(a), Block(Moved(b_from_a * a, w, u))});
  }
}

TEST(RelativePose, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(4);
  const Rigid3 a = random.Pose(), b_from_a = random.Pose();
  const Matrix6d covariance = 1e-3 * CorrelatedCovariance(&random);
  const Matrix6d factor = covariance.llt().matrixL();
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    Eigen::Matrix<double, 6, 1> d;
    for (int k = 0; k < 6; ++k) d[k] = random.Normal();
    d = factor * d;
    const CostPtr cost(RelativePose::Create(Moved(b_from_a, d.head<3>(), d.tail<3>()), covariance));
    samples.push_back(Residual(*cost, {Block(a), Block(b_from_a * a)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(ScaledRelativePose, WithUnitScaleEqualsRelativePose) {
  RandomGeometry random(5);
  const Rigid3 a = random.Pose(), b = random.Pose(), measured = random.Pose();
  const Matrix6d covariance = CorrelatedCovariance(&random);
  EXPECT_THAT(
      Residual(*CostPtr(ScaledRelativePose::Create(measured, covariance)),
               {Block(a), Block(b), {1.0}}),
      IsNear(Residual(*CostPtr(RelativePose::Create(measured, covariance)), {Block(a), Block(b)}),
             1e-9));
}

TEST(ScaledRelativePose, IsZeroIfTheTranslationIsScaled) {
  RandomGeometry random(6);
  const Rigid3 a = random.Pose(), b_from_a = random.Pose();
  const CostPtr cost(
      ScaledRelativePose::Create(Scaled(b_from_a, 1.0 / 1.2), CorrelatedCovariance(&random)));
  EXPECT_THAT(Residual(*cost, {Block(a), Block(b_from_a * a), {1.2}}), IsNear(kZero, 1e-9));
}

TEST(ScaledRelativePose, DerivativesMatch) {
  RandomGeometry random(7);
  for (const double scale : {0.0, 1.0, 1.3}) {
    const Rigid3 a = random.Pose(), b = random.Pose();
    ExpectGradientsMatch(
        *CostPtr(ScaledRelativePose::Create(random.Pose(), CorrelatedCovariance(&random))),
        {Block(a), Block(b), {scale}});
  }
}

// A chain of poses, of which the first and the last are known: the scale of the steps between them
// and the other poses follow.
TEST(ScaledRelativePose, RecoversTheScale) {
  RandomGeometry random(8);
  constexpr int kPoses = 6;
  std::vector<Rigid3> truth, poses;
  for (int i = 0; i < kPoses; ++i) {
    truth.push_back(random.Pose());
    poses.push_back(i == 0 || i + 1 == kPoses
                        ? truth[i]
                        : Moved(truth[i], 0.05 * random.Normal3(), 0.1 * random.Normal3()));
  }
  double scale = 1.0;
  Rigid3Manifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  for (Rigid3& pose : poses) problem.AddParameterBlock(pose.params.data(), 7, &manifold);
  problem.SetParameterBlockConstant(poses.front().params.data());
  problem.SetParameterBlockConstant(poses.back().params.data());
  for (int i = 0; i + 1 < kPoses; ++i) {
    const Rigid3 step = Scaled(truth[i + 1] * truth[i].Inverse(), 1.0 / 0.9);
    problem.AddResidualBlock(ScaledRelativePose::Create(step, 1e-4 * Matrix6d::Identity()), nullptr,
                             poses[i].params.data(), poses[i + 1].params.data(), &scale);
  }
  SolveToEnd(&problem);
  EXPECT_NEAR(scale, 0.9, 1e-7);
  for (int i = 0; i < kPoses; ++i) EXPECT_LT(Distance(poses[i], truth[i]), 1e-6) << i;
}

}  // namespace
}  // namespace msc_vo
