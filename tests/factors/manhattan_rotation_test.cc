// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/manhattan_rotation.h"

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/rotation3_manifold.h"

namespace msc_vo {
namespace {

std::vector<double> RotationBlock(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
Eigen::Quaterniond AnyRotation(RandomGeometry* random) { return random->Pose().rotation(); }

TEST(ManhattanRotation, IsZeroAlongItsAxisInEitherDirection) {
  RandomGeometry random(1);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Quaterniond q = AnyRotation(&random);
    const Eigen::Vector3d d = q * Eigen::Vector3d::Unit(axis);
    for (const Eigen::Vector3d& direction : {d, Eigen::Vector3d(-d)}) {
      EXPECT_THAT(
          Residual(*CostPtr(ManhattanRotation::Create(direction, axis, 0.01)), {RotationBlock(q)}),
          IsNear(Eigen::Vector2d::Zero(), 1e-12));
    }
  }
}

TEST(ManhattanRotation, MatchesValueByHand) {
  // The Manhattan frame coincides with the world.
  const Eigen::Vector3d n(0.8, -0.6, 0.0), d = Eigen::Vector3d(0.36, 0.48, 0.0) / 0.6;
  const Eigen::Vector3d tilted = (d + n.cross(d)).normalized();
  const auto residual = [&](int axis) {
    return Residual(*CostPtr(ManhattanRotation::Create(tilted, n, axis, 0.1, 0.01)),
                    {RotationBlock(Eigen::Quaterniond::Identity())});
  };
  const double s = 10.0 / std::sqrt(2.0);
  EXPECT_THAT(residual(0), IsNear(Eigen::Vector2d(-0.6 * s, 80.0), 1e-12));
  EXPECT_THAT(residual(1), IsNear(Eigen::Vector2d(-0.8 * s, -60.0), 1e-12));
  EXPECT_THAT(residual(2), IsNear(Eigen::Vector2d(s, 0.0), 1e-12));
}

TEST(ManhattanRotation, MatchesThePapersParallelAndPerpendicularErrors) {
  RandomGeometry random(2);
  const Eigen::Quaterniond q = AnyRotation(&random);
  const Eigen::Vector3d d = random.Normal3().normalized();
  const Eigen::VectorXd r =
      0.01 * Residual(*CostPtr(ManhattanRotation::Create(d, 1, 0.01)), {RotationBlock(q)});
  EXPECT_NEAR(r.norm(),
              std::hypot(d.dot(q * Eigen::Vector3d::UnitZ()), d.dot(q * Eigen::Vector3d::UnitX())),
              1e-12);
  EXPECT_NEAR(r.norm(), d.cross(q * Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(ManhattanRotation, DerivativesMatchEverywhereAndAlongEveryAxis) {
  RandomGeometry random(3);
  const Rotation3Manifold manifold;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Quaterniond q = AnyRotation(&random);
    std::vector<Eigen::Vector3d> directions{random.Normal3().normalized()};
    for (int k = 0; k < 3; ++k) {
      directions.push_back(q * Eigen::Vector3d::Unit(k));
      directions.push_back(-directions.back());
    }
    for (const Eigen::Vector3d& d : directions) {
      ExpectGradientsMatch(*CostPtr(ManhattanRotation::Create(d, axis, 0.01)), {RotationBlock(q)},
                           &manifold);
    }
  }
}

TEST(ManhattanRotation, DoesNotConstrainRotationAboutItsOwnAxis) {
  RandomGeometry random(4);
  const Eigen::Quaterniond q = AnyRotation(&random);
  const Eigen::Vector3d m = q * Eigen::Vector3d::UnitX();
  const Linearization at =
      Linearize(*CostPtr(ManhattanRotation::Create(m, 0, 0.01)), {RotationBlock(q)});
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
  Rotation3Manifold().PlusJacobian(q.coeffs().data(), plus.data());
  const Eigen::MatrixXd j = at.jacobians[0] * plus;
  EXPECT_THAT(j.transpose() * j,
              IsNear(((Eigen::Matrix3d::Identity() - m * m.transpose()) * 1e4).eval(), 1e-6));
}

TEST(ManhattanRotation, IsInvariantToRotationOfTheWorld) {
  RandomGeometry random(5);
  const Eigen::Quaterniond q = AnyRotation(&random), turn = AnyRotation(&random);
  const Eigen::Vector3d d = random.Normal3().normalized();
  const Eigen::Vector3d n = d.unitOrthogonal();
  EXPECT_THAT(
      Residual(*CostPtr(ManhattanRotation::Create(turn * d, turn * n, 2, 0.1, 0.01)),
               {RotationBlock(turn * q)}),
      IsNear(Residual(*CostPtr(ManhattanRotation::Create(d, n, 2, 0.1, 0.01)), {RotationBlock(q)}),
             1e-10));
}

TEST(ManhattanRotation, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(6);
  const double sigma = 0.01;
  const Eigen::Quaterniond q = AnyRotation(&random);
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d d =
        ExpSO3(sigma * random.Normal3()) * (q * Eigen::Vector3d::UnitZ()).eval();
    samples.push_back(
        Residual(*CostPtr(ManhattanRotation::Create(d, 2, sigma)), {RotationBlock(q)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(ManhattanRotation, RecoversARotationFromTwoAxes) {
  RandomGeometry random(7);
  const Eigen::Quaterniond truth = AnyRotation(&random);
  Eigen::Quaterniond q = ExpSO3(Eigen::Vector3d(0.1, -0.2, 0.15)) * truth;
  ceres::Problem problem;
  problem.AddParameterBlock(q.coeffs().data(), 4, new Rotation3Manifold);
  for (const int axis : {0, 2}) {
    problem.AddResidualBlock(
        ManhattanRotation::Create(truth * Eigen::Vector3d::Unit(axis), axis, 0.01), nullptr,
        q.coeffs().data());
  }
  SolveToEnd(&problem);
  EXPECT_LT(LogSO3(q * truth.conjugate()).norm(), 1e-9);
}

}  // namespace
}  // namespace msc_vo
