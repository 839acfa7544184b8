// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/perpendicular_lines.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

TEST(PerpendicularLines, IsZeroAtPerpendicular) {
  RandomGeometry random(1);
  const CostPtr cost(PerpendicularLines::Create(0.03));
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d d = random.Normal3().normalized();
    EXPECT_NEAR(Residual(*cost, {Block(random.LineAlong(d)),
                                 Block(random.LineAlong(d.cross(random.Normal3())))})[0],
                0.0, 1e-12);
  }
}

TEST(PerpendicularLines, MatchesSignedValueByHand) {
  // x against 3-4-5 in the xy plane: cosine 0.6.
  const CostPtr cost(PerpendicularLines::Create(0.1));
  const std::vector<double> x{1.0, 1.0, 1.0, 3.0, 1.0, 1.0};
  EXPECT_NEAR(Residual(*cost, {x, {0.0, 0.0, 0.0, 3.0, 4.0, 0.0}})[0], 6.0, 1e-12);
  EXPECT_NEAR(Residual(*cost, {x, {0.0, 0.0, 0.0, -3.0, 4.0, 0.0}})[0], -6.0, 1e-12);
}

TEST(PerpendicularLines, HasNonzeroDerivativeAtPerpendicular) {
  // |d_i . d_j| has no derivative here; that of the signed form is 1 / (sigma length).
  const LineSegment3 a{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, b{{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}};
  const Linearization at =
      Linearize(*CostPtr(PerpendicularLines::Create(0.1)), {Block(a), Block(b)});
  EXPECT_NEAR(at.jacobians[0](0, 4), 10.0, 1e-12);
  EXPECT_NEAR(at.jacobians[1](0, 3), 5.0, 1e-12);
}

TEST(PerpendicularLines, IsInvariantUpToSign) {
  RandomGeometry random(3);
  const CostPtr cost(PerpendicularLines::Create(0.03));
  const LineSegment3 a = random.Line(), b = random.Line();
  const Rigid3 motion = random.Pose();
  const double r = Residual(*cost, {Block(a), Block(b)})[0];
  EXPECT_NEAR(Residual(*cost, {Block(motion * a), Block(motion * b)})[0], r, 1e-10);
  EXPECT_NEAR(Residual(*cost, {Block(b), Block(a)})[0], r, 1e-12);
  EXPECT_NEAR(Residual(*cost, {Block(Swapped(a)), Block(b)})[0], -r, 1e-12);
  EXPECT_NEAR(Residual(*cost, {Block(Swapped(a)), Block(Swapped(b))})[0], r, 1e-12);
}

TEST(PerpendicularLines, HasUnitVarianceUnderItsNoise) {
  RandomGeometry random(4);
  const double sigma = 0.01;
  const CostPtr cost(PerpendicularLines::Create(sigma));
  const LineSegment3 a{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const double angle = sigma * random.Normal();
    const LineSegment3 b{{0.0, 1.0, 0.0}, {std::sin(angle), 1.0 + std::cos(angle), 0.0}};
    samples.push_back(Residual(*cost, {Block(a), Block(b)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(PerpendicularLines, MakesLinesPerpendicularFromEitherSide) {
  for (const double sign : {1.0, -1.0}) {
    LineSegment3 a{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    LineSegment3 b{{0.0, 1.0, 0.0}, {0.3 * sign, 2.0, 0.2}};
    ceres::Problem problem;
    problem.AddResidualBlock(PerpendicularLines::Create(0.03), nullptr, a.start.data(),
                             b.start.data());
    problem.SetParameterBlockConstant(a.start.data());
    SolveToEnd(&problem);
    EXPECT_NEAR(b.Direction().x(), 0.0, 1e-12);
    EXPECT_GT(b.Length(), 0.9);
  }
}

}  // namespace
}  // namespace msc_vo
