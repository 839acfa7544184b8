// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/parallel_lines.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

TEST(ParallelLines, IsZeroAtParallelForAnyOrderOfEndPoints) {
  RandomGeometry random(1);
  const CostPtr cost(ParallelLines::Create(0.03));
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d d = random.Normal3().normalized();
    const LineSegment3 a = random.LineAlong(d), b = random.LineAlong(d);
    EXPECT_THAT(Residual(*cost, {Block(a), Block(b)}), IsNear(Eigen::Vector3d::Zero(), 1e-12));
    EXPECT_THAT(Residual(*cost, {Block(a), Block(Swapped(b))}),
                IsNear(Eigen::Vector3d::Zero(), 1e-12));
  }
}

TEST(ParallelLines, MatchesValueByHand) {
  // x against 3-4-5 in the xy plane: sine 0.8, axis z.
  const CostPtr cost(ParallelLines::Create(0.1));
  EXPECT_THAT(Residual(*cost, {{1.0, 1.0, 1.0, 3.0, 1.0, 1.0}, {0.0, 0.0, 0.0, 3.0, 4.0, 0.0}}),
              IsNear(Eigen::Vector3d(0.0, 0.0, 8.0), 1e-12));
}

TEST(ParallelLines, NormEqualsThePapersError) {
  RandomGeometry random(2);
  const CostPtr cost(ParallelLines::Create(0.1));
  for (int i = 0; i < 10; ++i) {
    const LineSegment3 a = random.Line(), b = random.Line();
    const double d = std::abs(a.Direction().dot(b.Direction()));
    EXPECT_NEAR(0.1 * Residual(*cost, {Block(a), Block(b)}).norm(), std::sqrt(1.0 - d * d), 1e-9);
  }
}

TEST(ParallelLines, HasRankTwoAtParallel) {
  // In each line, both components of the angle.
  RandomGeometry random(4);
  const Eigen::Vector3d d = random.Normal3().normalized();
  const Linearization at = Linearize(*CostPtr(ParallelLines::Create(0.03)),
                                     {Block(random.LineAlong(d)), Block(random.LineAlong(-d))});
  for (const auto& jacobian : at.jacobians) {
    const Eigen::MatrixXd j = jacobian;
    const Eigen::VectorXd s = j.jacobiSvd().singularValues();
    EXPECT_NEAR(s[0], s[1], 1e-9 * s[0]);
    EXPECT_LT(s[2], 1e-9 * s[0]);
    EXPECT_THAT(j.leftCols(3) + j.rightCols(3), IsNear(Eigen::MatrixXd::Zero(3, 3), 1e-9));
  }
}

TEST(ParallelLines, NormIsInvariantToMotionAndOrder) {
  // Motion of the world rotates the residual; swapped lines or end points change its sign.
  RandomGeometry random(5);
  const CostPtr cost(ParallelLines::Create(0.03));
  const LineSegment3 a = random.Line(), b = random.Line();
  const Rigid3 motion = random.Pose();
  const Eigen::Vector3d r = Residual(*cost, {Block(a), Block(b)});
  EXPECT_THAT(Residual(*cost, {Block(motion * a), Block(motion * b)}),
              IsNear((motion.rotation() * r).eval(), 1e-10));
  EXPECT_THAT(Residual(*cost, {Block(b), Block(a)}), IsNear((-r).eval(), 1e-12));
  EXPECT_THAT(Residual(*cost, {Block(Swapped(a)), Block(b)}), IsNear((-r).eval(), 1e-12));
  EXPECT_THAT(Residual(*cost, {Block(Swapped(a)), Block(Swapped(b))}), IsNear(r, 1e-12));
}

TEST(ParallelLines, HasUnitCovarianceUnderNoiseAcrossTheLines) {
  RandomGeometry random(6);
  const double sigma = 0.01;
  const CostPtr cost(ParallelLines::Create(sigma));
  const LineSegment3 a{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const double y = random.Normal(), z = random.Normal();
    const LineSegment3 b{{0.0, 1.0, 0.0}, {1.0, 1.0 + sigma * y, sigma * z}};
    const Eigen::VectorXd r = Residual(*cost, {Block(a), Block(b)});
    EXPECT_EQ(r[0], 0.0);
    samples.push_back(r.tail(2));
  }
  ExpectIdentityCovariance(samples);
}

TEST(ParallelLines, AlignsALineFromEitherDirection) {
  RandomGeometry random(7);
  const LineSegment3 fixed{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  for (const double sign : {1.0, -1.0}) {
    LineSegment3 a = fixed;
    LineSegment3 b{{0.0, 1.0, 0.0}, {sign, 1.3, -0.2}};
    ceres::Problem problem;
    problem.AddResidualBlock(ParallelLines::Create(0.03), nullptr, a.start.data(), b.start.data());
    problem.SetParameterBlockConstant(a.start.data());
    SolveToEnd(&problem);
    EXPECT_NEAR(b.Direction().x(), sign, 1e-12);
    EXPECT_GT(b.Length(), 0.9);
  }
}

}  // namespace
}  // namespace msc_vo
