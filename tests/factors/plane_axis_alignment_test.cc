// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/plane_axis_alignment.h"

#include "tests/factors/plane_block.h"

#include "msc_vo/factors/plane_manifold.h"

namespace msc_vo {
namespace {

TEST(PlaneAxisAlignment, IsZeroOnTheAxisForBothSides) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized();
    const CostPtr cost(PlaneAxisAlignment::Create(axis, 0.01));
    EXPECT_LT(Residual(*cost, {Block(Plane(axis, random.Normal()))}).norm(), 1e-12);
    EXPECT_LT(Residual(*cost, {Block(Plane(-axis, random.Normal()))}).norm(), 1e-12);
  }
}

TEST(PlaneAxisAlignment, MatchesValueByHand) {
  // A normal of 3-4-5 in the xy plane against x: sine 0.8.
  const CostPtr cost(PlaneAxisAlignment::Create(Eigen::Vector3d(1.0, 0.0, 0.0), 0.1));
  EXPECT_NEAR(Residual(*cost, {Block(Plane({0.6, 0.8, 0.0}, 3.0))}).norm(), 8.0, 1e-12);
}

TEST(PlaneAxisAlignment, DoesNotDependOnMotionWithTheAxis) {
  RandomGeometry random(2);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized();
    const Plane plane(random.Normal3().normalized(), random.Normal());
    const Rigid3 motion = random.Pose();
    const CostPtr cost(PlaneAxisAlignment::Create(axis, 0.1));
    const CostPtr moved(PlaneAxisAlignment::Create(Eigen::Vector3d(motion.rotation() * axis), 0.1));
    EXPECT_NEAR(Residual(*cost, {Block(plane)}).norm(),
                Residual(*moved, {Block(motion * plane)}).norm(), 1e-10);
  }
}

TEST(PlaneAxisAlignment, DerivativesMatch) {
  RandomGeometry random(3);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized();
    const CostPtr cost(PlaneAxisAlignment::Create(axis, 0.05));
    const Plane tilted(random.Normal3().normalized(), random.Normal());
    ExpectGradientsMatch(*cost, {Block(tilted)}, &kPlaneManifold);
    ExpectGradientsMatch(*cost, {Block(Plane(-axis, 1.0))}, &kPlaneManifold);
  }
}

TEST(PlaneAxisAlignment, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(4);
  const double sigma = 0.01;
  const Eigen::Vector3d axis = random.Normal3().normalized();
  const Eigen::Vector3d a = axis.unitOrthogonal(), b = axis.cross(a);
  const CostPtr cost(PlaneAxisAlignment::Create(axis, sigma));
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d angle = sigma * random.Normal2();
    const Eigen::Vector3d normal = ExpSO3(angle.x() * a + angle.y() * b) * axis;
    samples.push_back(Residual(*cost, {Block(Plane(normal, 1.0))}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(PlaneAxisAlignment, TurnsAPlaneAndKeepsItsOffsetAndSide) {
  for (const double sign : {1.0, -1.0}) {
    Plane plane(Eigen::Vector3d(0.1, -0.2, sign).normalized(), 1.5);
    PlaneManifold manifold;
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(options);
    problem.AddParameterBlock(plane.params.data(), 4, &manifold);
    problem.AddResidualBlock(PlaneAxisAlignment::Create(Eigen::Vector3d(0.0, 0.0, 1.0), 0.01),
                             nullptr, plane.params.data());
    SolveToEnd(&problem);
    EXPECT_THAT(plane.normal(), IsNear(Eigen::Vector3d(0.0, 0.0, sign), 1e-9));
    EXPECT_NEAR(plane.offset(), 1.5, 1e-12);
  }
}

}  // namespace
}  // namespace msc_vo
