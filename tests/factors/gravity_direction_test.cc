// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/gravity_direction.h"

#include "tests/factors/direction_block.h"

namespace msc_vo {
namespace {

Eigen::Vector3d InCamera(const Rigid3& cam_from_world, const Eigen::Vector3d& direction) {
  return cam_from_world.rotation() * direction;
}

TEST(GravityDirection, IsZeroAtTheTruth) {
  RandomGeometry random(1);
  const Rigid3 pose = random.Pose();
  const Eigen::Vector3d up = AnyDirection(&random);
  // The length of the measurement does not matter.
  const CostPtr cost(GravityDirection::Create(9.81 * InCamera(pose, up), 0.01));
  EXPECT_THAT(Residual(*cost, {Block(pose), Block(up)}), IsNear(Eigen::Vector2d::Zero(), 1e-12));
}

TEST(GravityDirection, MatchesValueByHand) {
  const Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  const Rigid3 rolled(ExpSO3({0.0, 0.0, 0.2}), {1.0, 2.0, 3.0});
  EXPECT_NEAR(
      Residual(*CostPtr(GravityDirection::Create(up, 0.1)), {Block(rolled), Block(up)}).norm(),
      2.0 * std::tan(0.1) / 0.1, 1e-12);
}

TEST(GravityDirection, DoesNotDependOnPositionAndHeading) {
  RandomGeometry random(2);
  const Rigid3 pose = random.Pose();
  const Eigen::Vector3d up = AnyDirection(&random);
  const CostPtr cost(GravityDirection::Create(AnyDirection(&random), 0.1));
  const Rigid3 turned = pose * Rigid3(ExpSO3(0.7 * up), random.Normal3());
  EXPECT_THAT(Residual(*cost, {Block(turned), Block(up)}),
              IsNear(Residual(*cost, {Block(pose), Block(up)}), 1e-9));
}

TEST(GravityDirection, DerivativesMatch) {
  RandomGeometry random(3);
  for (const double distance : {0.0, 1e-3, 0.5, 2.0}) {
    const Rigid3 pose = random.Pose();
    const Eigen::Vector3d up = AnyDirection(&random);
    const Eigen::Vector3d measured = ExpSO3(distance * AnyDirection(&random)) * InCamera(pose, up);
    ExpectGradientsMatch(*CostPtr(GravityDirection::Create(measured, 0.1)),
                         {Block(pose), Block(up)}, &kUnitVectorManifold);
  }
}

TEST(GravityDirection, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(4);
  const Rigid3 pose = random.Pose();
  const Eigen::Vector3d up = AnyDirection(&random);
  const double sigma = 0.01;
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    // Of this noise, the part along the direction does not matter. The basis of the residual
    // depends on the measurement, but an isotropic covariance does not depend on the basis.
    const CostPtr cost(
        GravityDirection::Create(InCamera(pose, up) + sigma * random.Normal3(), sigma));
    samples.push_back(Residual(*cost, {Block(pose), Block(up)}));
  }
  ExpectIdentityCovariance(samples);
}

// Several cameras with known poses: the vertical follows, from an initial value 150 degrees off.
TEST(GravityDirection, RecoversTheVertical) {
  RandomGeometry random(5);
  const Eigen::Vector3d truth = AnyDirection(&random);
  Eigen::Vector3d up = ExpSO3(2.6 * truth.unitOrthogonal()) * truth;
  UnitVectorManifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  problem.AddParameterBlock(up.data(), 3, &manifold);
  std::vector<Rigid3> poses(3);
  for (Rigid3& pose : poses) {
    pose = random.Pose();
    problem.AddResidualBlock(GravityDirection::Create(InCamera(pose, truth), 0.01), nullptr,
                             pose.params.data(), up.data());
    problem.SetParameterBlockConstant(pose.params.data());
  }
  SolveToEnd(&problem);
  EXPECT_THAT(up, IsNear(truth, 1e-7));
}

}  // namespace
}  // namespace msc_vo
