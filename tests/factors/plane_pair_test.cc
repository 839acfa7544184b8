// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/plane_pair.h"

#include "tests/factors/plane_block.h"

#include "msc_vo/factors/plane_manifold.h"

namespace msc_vo {
namespace {

TEST(PlanePair, IsZeroAtTheRelationAtAnyDistance) {
  RandomGeometry random(1);
  const CostPtr parallel(ParallelPlanes::Create(0.01));
  const CostPtr perpendicular(PerpendicularPlanes::Create(0.01));
  for (int i = 0; i < 10; ++i) {
    const Plane a = RandomPlane(&random);
    const Plane same(a.normal(), random.Normal()), opposite(-a.normal(), random.Normal());
    const Plane across(a.normal().unitOrthogonal(), random.Normal());
    EXPECT_LT(Residual(*parallel, {Block(a), Block(same)}).norm(), 1e-12);
    EXPECT_LT(Residual(*parallel, {Block(a), Block(opposite)}).norm(), 1e-12);
    EXPECT_LT(Residual(*perpendicular, {Block(a), Block(across)}).norm(), 1e-12);
  }
}

TEST(PlanePair, MatchesValuesByHand) {
  // x against 3-4-5 in the xy plane: sine 0.8 about z, cosine 0.6.
  const Blocks blocks{{1.0, 0.0, 0.0, 2.0}, {0.6, 0.8, 0.0, -1.0}};
  EXPECT_THAT(Residual(*CostPtr(ParallelPlanes::Create(0.1)), blocks),
              IsNear(Eigen::Vector3d(0.0, 0.0, 8.0), 1e-12));
  EXPECT_NEAR(Residual(*CostPtr(PerpendicularPlanes::Create(0.1)), blocks)[0], 6.0, 1e-12);
}

TEST(PlanePair, NormIsInvariantToMotionOrderAndSides) {
  RandomGeometry random(2);
  const CostPtr parallel(ParallelPlanes::Create(0.03));
  const CostPtr perpendicular(PerpendicularPlanes::Create(0.03));
  const Plane a = RandomPlane(&random), b = RandomPlane(&random);
  const Plane back(-b.normal(), -b.offset());
  const Rigid3 motion = random.Pose();
  const std::vector<Blocks> alike{
      {Block(motion * a), Block(motion * b)}, {Block(b), Block(a)}, {Block(a), Block(back)}};
  for (const Blocks& blocks : alike) {
    for (const CostPtr* cost : {&parallel, &perpendicular}) {
      EXPECT_NEAR(Residual(**cost, blocks).norm(), Residual(**cost, {Block(a), Block(b)}).norm(),
                  1e-10);
    }
  }
}

TEST(PlanePair, DerivativesMatch) {
  RandomGeometry random(3);
  const CostPtr parallel(ParallelPlanes::Create(0.05));
  const CostPtr perpendicular(PerpendicularPlanes::Create(0.05));
  for (int i = 0; i < 5; ++i) {
    const Plane a = RandomPlane(&random), b = RandomPlane(&random);
    const Plane across(a.normal().unitOrthogonal(), 0.5);
    for (const CostPtr* cost : {&parallel, &perpendicular}) {
      ExpectGradientsMatch(**cost, {Block(a), Block(b)}, &kPlaneManifold);
      ExpectGradientsMatch(**cost, {Block(a), Block(a)}, &kPlaneManifold);
      ExpectGradientsMatch(**cost, {Block(a), Block(across)}, &kPlaneManifold);
    }
  }
}

TEST(PlanePair, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(4);
  const double sigma = 0.01;
  const CostPtr parallel(ParallelPlanes::Create(sigma));
  const CostPtr perpendicular(PerpendicularPlanes::Create(sigma));
  const Plane fixed({0.0, 0.0, 1.0}, 1.0);
  std::vector<Eigen::VectorXd> angles, cosines;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d angle = sigma * random.Normal2();
    const Eigen::Matrix3d turn = ExpSO3({angle.x(), angle.y(), 0.0}).toRotationMatrix();
    const Eigen::Vector3d along = turn.col(2), across = turn.col(0);
    const Eigen::VectorXd r = Residual(*parallel, {Block(fixed), Block(Plane(along, 2.0))});
    EXPECT_EQ(r[2], 0.0);  // none about the common normal
    angles.emplace_back(r.head(2));
    cosines.push_back(Residual(*perpendicular, {Block(fixed), Block(Plane(across, 2.0))}));
  }
  ExpectIdentityCovariance(angles);
  ExpectIdentityCovariance(cosines);
}

// A floor that is fixed, a ceiling and a wall: the one becomes parallel, the other perpendicular to
// it, and their offsets stay.
TEST(PlanePair, RecoversARoom) {
  Plane floor(Eigen::Vector3d(0.1, -0.9, 0.2).normalized(), 1.2);
  Plane ceiling(-(floor.normal() + Eigen::Vector3d(0.05, 0.0, -0.08)).normalized(), 1.4);
  Plane wall((floor.normal().unitOrthogonal() + 0.1 * floor.normal()).normalized(), 2.0);
  PlaneManifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  for (Plane* plane : {&floor, &ceiling, &wall}) {
    problem.AddParameterBlock(plane->params.data(), 4, &manifold);
  }
  problem.SetParameterBlockConstant(floor.params.data());
  problem.AddResidualBlock(ParallelPlanes::Create(0.01), nullptr, floor.params.data(),
                           ceiling.params.data());
  problem.AddResidualBlock(PerpendicularPlanes::Create(0.01), nullptr, wall.params.data(),
                           floor.params.data());
  SolveToEnd(&problem);
  EXPECT_THAT(ceiling.normal(), IsNear(Eigen::Vector3d(-floor.normal()), 1e-9));
  EXPECT_NEAR(wall.normal().dot(floor.normal()), 0.0, 1e-9);
  EXPECT_NEAR(ceiling.offset(), 1.4, 1e-12);
  EXPECT_NEAR(wall.offset(), 2.0, 1e-12);
}

}  // namespace
}  // namespace msc_vo
