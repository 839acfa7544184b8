// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/manhattan_axis_alignment.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

TEST(ManhattanAxisAlignment, IsZeroAlongTheAxisInEitherDirection) {
  RandomGeometry random(1);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized(), start = random.Normal3();
    const CostPtr cost(ManhattanAxisAlignment::Create(axis, 0.03));
    for (const double length : {0.7, -2.0}) {
      EXPECT_THAT(Residual(*cost, {Block(LineSegment3{start, start + length * axis})}),
                  IsNear(Eigen::Vector2d::Zero(), 1e-12));
    }
  }
}

TEST(ManhattanAxisAlignment, MatchesValueByHand) {
  // 3-4-5 in the xy plane against x: sine 0.8.
  const CostPtr cost(ManhattanAxisAlignment::Create(Eigen::Vector3d::UnitX(), 0.1));
  EXPECT_NEAR(Residual(*cost, {{0.0, 0.0, 0.0, 3.0, 4.0, 0.0}}).norm(), 8.0, 1e-12);
  EXPECT_NEAR(Residual(*cost, {{5.0, 1.0, 0.0, 5.0, 1.0, 2.0}}).norm(), 10.0,
              1e-12);  // perpendicular
}

TEST(ManhattanAxisAlignment, NormEqualsTheSine) {
  RandomGeometry random(2);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized();
    const LineSegment3 line = random.Line();
    EXPECT_NEAR(
        0.03 * Residual(*CostPtr(ManhattanAxisAlignment::Create(axis, 0.03)), {Block(line)}).norm(),
        axis.cross(line.Direction()).norm(), 1e-12);
  }
}

TEST(ManhattanAxisAlignment, DerivativesMatchAtParallelOppositeAndPerpendicular) {
  RandomGeometry random(3);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d axis = random.Normal3().normalized(), start = random.Normal3();
    const CostPtr cost(ManhattanAxisAlignment::Create(axis, 0.03));
    ExpectGradientsMatch(*cost, {Block(random.Line())});
    for (const Eigen::Vector3d& d : {axis, Eigen::Vector3d(-axis), axis.unitOrthogonal().eval()}) {
      ExpectGradientsMatch(*cost, {Block(LineSegment3{start, start + 0.8 * d})});
    }
  }
}

TEST(ManhattanAxisAlignment, HasFullRankAtTheAxis) {
  const CostPtr cost(ManhattanAxisAlignment::Create(Eigen::Vector3d::UnitZ(), 0.1));
  const Eigen::MatrixXd j =
      Linearize(*cost, {{0.0, 0.0, 0.0, 0.0, 0.0, 2.0}}).jacobians[0].rightCols(3);
  // 1 / (sigma length) across the line, 0 along it.
  EXPECT_THAT(j * j.transpose(), IsNear((25.0 * Eigen::MatrixXd::Identity(2, 2)).eval(), 1e-9));
  EXPECT_EQ(j.col(2).norm(), 0.0);
}

TEST(ManhattanAxisAlignment, NormIsInvariantToMotionSwappedEndPointsAndSignOfTheAxis) {
  RandomGeometry random(4);
  const Eigen::Vector3d axis = random.Normal3().normalized();
  const LineSegment3 line = random.Line(), swapped{line.end, line.start};
  const Rigid3 motion = random.Pose();
  const auto norm = [](const Eigen::Vector3d& a, const LineSegment3& l) {
    return Residual(*CostPtr(ManhattanAxisAlignment::Create(a, 0.03)), {Block(l)}).norm();
  };
  const double r = norm(axis, line);
  EXPECT_NEAR(norm(motion.rotation() * axis, motion * line), r, 1e-10);
  EXPECT_NEAR(norm(axis, swapped), r, 1e-12);
  EXPECT_NEAR(norm(-axis, line), r, 1e-12);
}

TEST(ManhattanAxisAlignment, IsUndefinedForZeroLength) {
  const CostPtr cost(ManhattanAxisAlignment::Create(Eigen::Vector3d::UnitX(), 0.03));
  EXPECT_FALSE(IsDefined(*cost, {{1.0, 2.0, 3.0, 1.0, 2.0, 3.0}}));
}

TEST(ManhattanAxisAlignment, HasUnitCovarianceUnderItsNoise) {
  RandomGeometry random(5);
  const double sigma = 0.01;
  const CostPtr cost(ManhattanAxisAlignment::Create(Eigen::Vector3d::UnitY(), sigma));
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d noise = sigma * random.Normal2();
    samples.push_back(Residual(*cost, {{0.0, 0.0, 0.0, noise.x(), 1.0, noise.y()}}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(ManhattanAxisAlignment, AlignsALineWithItsAxis) {
  LineSegment3 line{{0.0, 1.0, 0.0}, {0.2, 1.3, -1.0}};
  ceres::Problem problem;
  problem.AddResidualBlock(ManhattanAxisAlignment::Create(Eigen::Vector3d::UnitZ(), 0.03), nullptr,
                           line.start.data());
  SolveToEnd(&problem);
  EXPECT_NEAR(line.Direction().z(), -1.0, 1e-12);
  EXPECT_GT(line.Length(), 0.9);
}

}  // namespace
}  // namespace msc_vo
