// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/pose_prior.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

using Matrix6d = PosePrior::Matrix6d;

// Full covariance with very different sigmas.
Matrix6d UnequalCovariance(RandomGeometry* random) {
  Matrix6d factor;
  for (int i = 0; i < 36; ++i) factor.data()[i] = random->Normal();
  for (int i = 0; i < 6; ++i) factor.row(i) *= 0.01 * (1 + i);
  return factor * factor.transpose() + 1e-6 * Matrix6d::Identity();
}

TEST(PosePrior, IsZeroAtTheMean) {
  RandomGeometry random(1);
  const Rigid3 mean = random.Pose();
  EXPECT_THAT(
      Residual(*CostPtr(PosePrior::Create(mean, UnequalCovariance(&random))), {Block(mean)}),
      IsNear(Eigen::VectorXd(Eigen::VectorXd::Zero(6)), 1e-9));
}

TEST(PosePrior, MatchesValueByHand) {
  // 0.2 rad about the camera's z and 3 m along its x, with sigmas 0.1 rad and 2 m.
  RandomGeometry random(2);
  const Rigid3 mean = random.Pose();
  Matrix6d covariance = Matrix6d::Identity();
  covariance.diagonal() << 0.01, 0.01, 0.01, 4.0, 4.0, 4.0;
  Eigen::VectorXd expected(6);
  expected << 0.0, 0.0, 2.0, 1.5, 0.0, 0.0;
  EXPECT_THAT(Residual(*CostPtr(PosePrior::Create(mean, covariance)),
                       {Block(Moved(mean, {0.0, 0.0, 0.2}, {3.0, 0.0, 0.0}))}),
              IsNear(expected, 1e-12));
}

TEST(PosePrior, SquareEqualsTheMahalanobisDistance) {
  RandomGeometry random(3);
  const Rigid3 mean = random.Pose();
  const Matrix6d covariance = UnequalCovariance(&random);
  Eigen::Matrix<double, 6, 1> d;
  d << 0.1, -0.2, 0.05, 0.3, 0.1, -0.4;
  const Eigen::VectorXd r = Residual(*CostPtr(PosePrior::Create(mean, covariance)),
                                     {Block(Moved(mean, d.head<3>(), d.tail<3>()))});
  const double expected = d.dot(covariance.inverse() * d);
  EXPECT_NEAR(r.squaredNorm(), expected, 1e-8 * expected);
}

TEST(PosePrior, DerivativesMatch) {
  RandomGeometry random(4);
  Matrix6d covariance = UnequalCovariance(&random) + 0.01 * Matrix6d::Identity();
  for (const double distance : {0.0, 1e-3, 0.5, 2.0}) {
    const Rigid3 mean = random.Pose();
    const Eigen::Vector3d w = distance * random.Normal3().normalized(), u = random.Normal3();
    ExpectGradientsMatch(*CostPtr(PosePrior::Create(mean, covariance)), {Block(Moved(mean, w, u))});
  }
}

TEST(PosePrior, TangentJacobianMatchesAutomaticDerivative) {
  RandomGeometry random(5);
  const Matrix6d covariance = UnequalCovariance(&random);
  for (const double distance : {0.0, 1e-7, 1e-3, 9e-3, 0.5, 3.0}) {
    const Rigid3 mean = random.Pose();
    const Rigid3 pose = Moved(mean, distance * random.Normal3().normalized(), random.Normal3());
    const PosePrior factor(mean, covariance);
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
    Rigid3Manifold().PlusJacobian(pose.params.data(), plus.data());
    const Eigen::MatrixXd expected =
        Linearize(*CostPtr(PosePrior::Create(factor)), {Block(pose)}).jacobians[0] * plus;
    EXPECT_THAT(factor.TangentJacobian(pose), IsNear(expected, 1e-9 * expected.norm())) << distance;
  }
}

TEST(PosePrior, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(6);
  const Rigid3 mean = random.Pose();
  const Matrix6d covariance = 0.01 * UnequalCovariance(&random);
  const Matrix6d factor = covariance.llt().matrixL();
  const CostPtr cost(PosePrior::Create(mean, covariance));
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    Eigen::Matrix<double, 6, 1> d;
    for (int k = 0; k < 6; ++k) d[k] = random.Normal();
    d = factor * d;
    samples.push_back(Residual(*cost, {Block(Moved(mean, d.head<3>(), d.tail<3>()))}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(PosePrior, TwoEqualPriorsGiveTheMidpoint) {
  RandomGeometry random(7);
  const Rigid3 mean = random.Pose();
  const Eigen::Vector3d w(0.1, -0.2, 0.3), u(0.4, 0.5, -0.6);
  const Matrix6d covariance = 0.01 * Matrix6d::Identity();
  Rigid3 pose = random.Pose();
  Rigid3Manifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  problem.AddResidualBlock(PosePrior::Create(mean, covariance), nullptr, pose.params.data());
  problem.AddResidualBlock(PosePrior::Create(Moved(mean, w, u), covariance), nullptr,
                           pose.params.data());
  problem.SetManifold(pose.params.data(), &manifold);
  SolveToEnd(&problem);
  EXPECT_LT(Distance(pose, Moved(mean, 0.5 * w, 0.5 * u)), 1e-7);
}

}  // namespace
}  // namespace msc_vo
