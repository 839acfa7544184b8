// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/line_endpoint_prior.h"

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/line_reprojection.h"

namespace msc_vo {
namespace {

const LineSegment3 kInitial{{1.0, 2.0, 3.0}, {1.0, 4.0, 3.0}};  // along y

TEST(LineEndpointPrior, IsZeroAtTheInitialLine) {
  EXPECT_EQ(Residual(*CostPtr(LineEndpointPrior::Create(kInitial, 0.05)), {Block(kInitial)}),
            Eigen::VectorXd(Eigen::Vector2d::Zero()));
}

TEST(LineEndpointPrior, MatchesValueByHand) {
  // S moves by 0.1 m along the line and E by -0.2 m; motion across it has no effect.
  const CostPtr cost(LineEndpointPrior::Create(kInitial, 0.05));
  EXPECT_THAT(Residual(*cost, {{1.5, 2.1, 3.0, 1.0, 3.8, 2.0}}),
              IsNear(Eigen::Vector2d(2.0, -4.0), 1e-12));
}

TEST(LineEndpointPrior, DerivativesMatch) {
  RandomGeometry random(1);
  for (int i = 0; i < 5; ++i) {
    const LineSegment3 initial{random.Normal3(), random.Normal3()};
    const LineSegment3 line{random.Normal3(), random.Normal3()};
    ExpectGradientsMatch(*CostPtr(LineEndpointPrior::Create(initial, 0.05)), {Block(line)});
  }
}

TEST(LineEndpointPrior, LeavesTheFourDegreesOfFreedomOfALineFree) {
  // Motion of an end point across the line does not change the residual.
  RandomGeometry random(2);
  const LineSegment3 initial{random.Normal3(), random.Normal3()};
  const Eigen::Vector3d d = initial.Direction();
  const CostPtr cost(LineEndpointPrior::Create(initial, 0.05));
  const Linearization at = Linearize(*cost, {Block(initial)});
  for (const Eigen::Vector3d& across : {d.unitOrthogonal(), d.cross(d.unitOrthogonal()).eval()}) {
    EXPECT_NEAR((at.jacobians[0].leftCols(3) * across).norm(), 0.0, 1e-12);
    EXPECT_NEAR((at.jacobians[0].rightCols(3) * across).norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR(at.jacobians[0].leftCols(3).row(0).dot(d), 20.0, 1e-12);
  EXPECT_NEAR(at.jacobians[0].rightCols(3).row(1).dot(d), 20.0, 1e-12);
}

TEST(LineEndpointPrior, IsInvariantToMotionOfTheWorldAndSwapsWithTheEndPoints) {
  RandomGeometry random(3);
  const Rigid3 shift = random.Pose();
  const LineSegment3 initial{random.Normal3(), random.Normal3()};
  const LineSegment3 line{random.Normal3(), random.Normal3()};
  const Eigen::VectorXd r =
      Residual(*CostPtr(LineEndpointPrior::Create(initial, 0.05)), {Block(line)});
  EXPECT_THAT(
      Residual(*CostPtr(LineEndpointPrior::Create(shift * initial, 0.05)), {Block(shift * line)}),
      IsNear(r, 1e-10));
  const LineSegment3 initial_back{initial.end, initial.start}, line_back{line.end, line.start};
  EXPECT_THAT(Residual(*CostPtr(LineEndpointPrior::Create(initial_back, 0.05)), {Block(line_back)}),
              IsNear(Eigen::Vector2d(-r[1], -r[0]), 1e-10));
}

TEST(LineEndpointPrior, HasUnitCovarianceUnderNoiseAlongTheLine) {
  RandomGeometry random(4);
  const double sigma = 0.05;
  const CostPtr cost(LineEndpointPrior::Create(kInitial, sigma));
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const LineSegment3 line{kInitial.start + sigma * random.Normal3(),
                            kInitial.end + sigma * random.Normal3()};
    samples.push_back(Residual(*cost, {Block(line)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST(LineEndpointPrior, DeterminesTheEndPointsOfALineFromTwoViews) {
  // Two views determine the line but not its end points.
  const PinholeCamera camera;
  const LineSegment3 truth{{-0.4, 0.1, 2.0}, {0.6, 0.3, 3.0}};
  const LineSegment3 initial{{-0.45, 0.15, 2.1}, {0.6, 0.25, 2.9}};
  LineSegment3 line = initial;
  std::vector<Rigid3> poses{Rigid3(), Rigid3(ExpSO3({0.1, 0.1, 0.0}), {0.3, 0.5, 0.1})};
  ceres::Problem problem;
  for (Rigid3& pose : poses) {
    const LineSegment3 in_cam = pose * truth;
    const LineSegment2 observed{camera.Project(in_cam.start), camera.Project(in_cam.end)};
    problem.AddResidualBlock(LineReprojection::Create(camera, observed, 1.0, 1.0), nullptr,
                             pose.params.data(), line.start.data());
    problem.SetParameterBlockConstant(pose.params.data());
  }
  problem.AddResidualBlock(LineEndpointPrior::Create(initial, 0.05), nullptr, line.start.data());
  SolveToEnd(&problem);
  EXPECT_LT(truth.DistanceToLine(line.start), 1e-8);
  EXPECT_LT(truth.DistanceToLine(line.end), 1e-8);
  EXPECT_NEAR((line.start - initial.start).dot(initial.Direction()), 0.0, 1e-8);
  EXPECT_NEAR((line.end - initial.end).dot(initial.Direction()), 0.0, 1e-8);
}

}  // namespace
}  // namespace msc_vo
