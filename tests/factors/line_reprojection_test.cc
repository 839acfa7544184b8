// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/line_reprojection.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

// Parameter: fy, which is negative for mirrored images.
class LineReprojectionTest : public ::testing::TestWithParam<double> {
 protected:
  LineReprojectionTest() {
    camera_.fx = 500.0;
    camera_.fy = GetParam();
    camera_.cx = 320.0;
    camera_.cy = 240.0;
  }
  LineSegment2 Project(const LineSegment3& line) const {
    return {camera_.Project(line.start), camera_.Project(line.end)};
  }
  // A line in camera coordinates.
  LineSegment3 InView() {
    const Eigen::Vector3d start = random_.InView(), end = random_.InView();
    return {start, end};
  }
  PinholeCamera camera_;
  RandomGeometry random_{1};
  const LineSegment2 somewhere_{{100.0, 150.0}, {300.0, 200.0}};
};
INSTANTIATE_TEST_SUITE_P(FocalLength, LineReprojectionTest, ::testing::Values(400.0, -400.0));

TEST_P(LineReprojectionTest, IsZeroAtTruthForAnyObservedPart) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const LineSegment3 line = InView();
    const LineSegment2 whole = Project(line);
    for (const LineSegment2& observed : {whole, LineSegment2{whole.At(0.3), whole.At(0.5)},
                                         LineSegment2{whole.At(-0.2), whole.At(1.4)}}) {
      const CostPtr cost(LineReprojection::Create(camera_, observed, 1.0, 1.0));
      EXPECT_THAT(Residual(*cost, {Block(pose), Block(pose.Inverse() * line)}),
                  IsNear(Eigen::Vector2d::Zero(), 1e-8));
    }
  }
}

TEST_P(LineReprojectionTest, MatchesValueByHand) {
  // The observed line is the row v = 250 from left to right: n = (0, 1). S = (0, 0, 2) projects to
  // v = 240, ten pixels above it; E = (0.2, 0.1, 2) to v = 240 +- 20.
  const LineSegment2 observed{{100.0, 250.0}, {200.0, 250.0}};
  const CostPtr cost(LineReprojection::Create(camera_, observed, 2.0, 4.0));
  const double end = camera_.fy > 0.0 ? 10.0 / 4.0 : -30.0 / 4.0;
  EXPECT_THAT(Residual(*cost, {Block(Rigid3()), {0.0, 0.0, 2.0, 0.2, 0.1, 2.0}}),
              IsNear(Eigen::Vector2d(-5.0, end), 1e-12));
}

TEST_P(LineReprojectionTest, DerivativesMatch) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const Blocks blocks{Block(pose), Block(pose.Inverse() * InView())};
    const LineReprojection factor(camera_, somewhere_, 0.9, 1.7);
    ExpectGradientsMatch(*CostPtr(LineReprojection::Create(factor)), blocks);
    ExpectAnalyticMatchesAutomatic(factor, blocks);
  }
}

// The line begins behind the camera; its last tenth is in front.
TEST_P(LineReprojectionTest, DerivativesOfPartMatch) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const LineSegment3 whole{Eigen::Vector3d(0.3, -0.2, -1.0), random_.InView()};
    LineReprojection factor(camera_, somewhere_, 0.9, 1.7);
    const Blocks blocks{Block(pose), Block(pose.Inverse() * whole)};
    EXPECT_FALSE(factor(blocks[0].data(), blocks[1].data(), Eigen::Vector2d().data()));
    factor.SetPart({0.9, 1.0});
    ExpectGradientsMatch(*CostPtr(LineReprojection::Create(factor)), blocks);
    ExpectAnalyticMatchesAutomatic(factor, blocks);
  }
}

TEST_P(LineReprojectionTest, IsInvariantToMotionOfTheWorld) {
  const Rigid3 pose = random_.Pose(), shift = random_.Pose();
  const LineSegment3 line = pose.Inverse() * InView();
  const CostPtr cost(LineReprojection::Create(camera_, somewhere_, 0.9, 1.7));
  EXPECT_THAT(Residual(*cost, {Block(pose * shift.Inverse()), Block(shift * line)}),
              IsNear(Residual(*cost, {Block(pose), Block(line)}), 1e-8));
}

TEST_P(LineReprojectionTest, SwappedEndPointsSwapRowsOrSigns) {
  const LineSegment3 line = InView();
  const Eigen::VectorXd r =
      Residual(*CostPtr(LineReprojection::Create(camera_, somewhere_, 0.9, 1.7)),
               {Block(Rigid3()), Block(line)});
  const LineSegment3 swapped{line.end, line.start};
  EXPECT_THAT(Residual(*CostPtr(LineReprojection::Create(camera_, somewhere_, 1.7, 0.9)),
                       {Block(Rigid3()), Block(swapped)}),
              IsNear(Eigen::Vector2d(r[1], r[0]), 1e-10));
  const LineSegment2 observed{somewhere_.end, somewhere_.start};
  EXPECT_THAT(Residual(*CostPtr(LineReprojection::Create(camera_, observed, 0.9, 1.7)),
                       {Block(Rigid3()), Block(line)}),
              IsNear(Eigen::Vector2d(-r), 1e-10));
}

TEST_P(LineReprojectionTest, IsInvariantToMotionAlongTheLine) {
  const LineSegment3 line = InView();
  const CostPtr cost(LineReprojection::Create(camera_, Project(line), 1.0, 1.0));
  const LineSegment3 shifted{line.At(0.2), line.At(1.1)};
  EXPECT_THAT(Residual(*cost, {Block(Rigid3()), Block(shifted)}),
              IsNear(Eigen::Vector2d::Zero(), 1e-9));
}

TEST_P(LineReprojectionTest, HasUnitCovarianceUnderNoiseOfTheEndPoints) {
  // The rows are independent because the map line ends at the ends of the segment.
  const LineSegment3 line{{-0.4, 0.1, 2.0}, {0.6, 0.3, 3.0}};
  const LineSegment2 exact = Project(line);
  const Eigen::Vector2d across(-exact.Direction().y(), exact.Direction().x());
  const double sigma = 1.3;
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d noise = sigma * random_.Normal2();
    const LineSegment2 observed{exact.start + noise.x() * across, exact.end + noise.y() * across};
    samples.push_back(Residual(*CostPtr(LineReprojection::Create(camera_, observed, sigma, sigma)),
                               {Block(Rigid3()), Block(line)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST_P(LineReprojectionTest, IsUndefinedIfAnEndPointIsBehindTheCamera) {
  const CostPtr cost(LineReprojection::Create(camera_, somewhere_, 1.0, 1.0));
  EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, -1.0, 0.2, 0.1, 2.0}}));
  EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, 1.0, 0.2, 0.1, 0.0}}));
}

TEST_P(LineReprojectionTest, RecoversAPose) {
  const Rigid3 truth = random_.Pose();
  Rigid3 pose = Moved(truth, {0.05, -0.05, 0.05}, {0.05, 0.1, -0.05});
  std::vector<LineSegment3> lines;
  for (int i = 0; i < 8; ++i) lines.push_back(truth.Inverse() * InView());
  ceres::Problem problem;
  problem.AddParameterBlock(pose.params.data(), 7, new Rigid3Manifold);
  for (LineSegment3& line : lines) {
    problem.AddResidualBlock(LineReprojection::Create(camera_, Project(truth * line), 1.0, 1.0),
                             nullptr, pose.params.data(), line.start.data());
    problem.SetParameterBlockConstant(line.start.data());
  }
  SolveToEnd(&problem);
  EXPECT_LT(Distance(pose, truth), 1e-8);
}

}  // namespace
}  // namespace msc_vo
