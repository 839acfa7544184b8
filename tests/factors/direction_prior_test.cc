// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/direction_prior.h"

#include "tests/factors/direction_block.h"

namespace msc_vo {
namespace {

TEST(DirectionPrior, IsZeroAtTheMean) {
  RandomGeometry random(1);
  const Eigen::Vector3d mean = AnyDirection(&random);
  // The length of the mean does not matter.
  EXPECT_THAT(Residual(*CostPtr(DirectionPrior::Create(9.81 * mean, 0.01)), {Block(mean)}),
              IsNear(Eigen::VectorXd(Eigen::VectorXd::Zero(2)), 1e-12));
}

TEST(DirectionPrior, MatchesValueByHand) {
  const CostPtr cost(DirectionPrior::Create(Eigen::Vector3d::UnitZ(), 0.1));
  for (const double angle : {0.2, 1.5, 3.0}) {
    const Eigen::Vector3d direction(std::sin(angle), 0.0, std::cos(angle));
    EXPECT_NEAR(Residual(*cost, {Block(direction)}).norm(), 2.0 * std::tan(angle / 2.0) / 0.1,
                1e-9);
  }
}

TEST(DirectionPrior, IsUndefinedInTheOppositeDirection) {
  const Eigen::Vector3d mean = Eigen::Vector3d::UnitY();
  EXPECT_FALSE(IsDefined(*CostPtr(DirectionPrior::Create(mean, 0.1)), {Block(-mean)}));
}

TEST(DirectionPrior, DerivativesMatch) {
  RandomGeometry random(2);
  for (const double distance : {0.0, 1e-3, 0.5, 2.0}) {
    const Eigen::Vector3d mean = AnyDirection(&random);
    const Eigen::Vector3d direction = ExpSO3(distance * mean.unitOrthogonal()) * mean;
    ExpectGradientsMatch(*CostPtr(DirectionPrior::Create(mean, 0.1)), {Block(direction)},
                         &kUnitVectorManifold);
  }
}

}  // namespace
}  // namespace msc_vo
