// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/line_depth_reprojection.h"

#include "tests/support/factor_checks.h"
#include <Eigen/Cholesky>

#include "msc_vo/factors/line_reprojection.h"

namespace msc_vo {
namespace {

// Parameter: fy, which is negative for mirrored images.
class LineDepthReprojectionTest : public ::testing::TestWithParam<double> {
 protected:
  LineDepthReprojectionTest() {
    camera_.fx = 500.0;
    camera_.fy = GetParam();
    camera_.cx = 320.0;
    camera_.cy = 240.0;
    depth_.start = 0.4;
    depth_.end = 0.6;
  }
  LineSegment2 Project(const LineSegment3& line) const {
    return {camera_.Project(line.start), camera_.Project(line.end)};
  }
  LineSegment3 InView() {
    const Eigen::Vector3d start = random_.InView(), end = random_.InView();
    return {start, end};
  }
  static LineDepth DepthOf(const LineSegment3& line) {
    LineDepth depth;
    depth.start = 1.0 / line.start.z();
    depth.end = 1.0 / line.end.z();
    return depth;
  }
  PinholeCamera camera_;
  RandomGeometry random_{1};
  const LineSegment2 somewhere_{{100.0, 150.0}, {300.0, 200.0}};
  LineDepth depth_;
};
INSTANTIATE_TEST_SUITE_P(FocalLength, LineDepthReprojectionTest, ::testing::Values(400.0, -400.0));

TEST_P(LineDepthReprojectionTest, IsZeroAtTruthForAnyObservedPart) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const LineSegment3 line = InView();
    const LineSegment3 part{line.At(0.2), line.At(0.7)};
    for (const LineSegment3& seen : {line, part}) {
      const CostPtr cost(
          LineDepthReprojection::Create(camera_, Project(seen), DepthOf(seen), 0.002, 0.002));
      EXPECT_THAT(Residual(*cost, {Block(pose), Block(pose.Inverse() * line)}),
                  IsNear(Eigen::Vector2d::Zero(), 1e-8));
    }
  }
}

TEST_P(LineDepthReprojectionTest, MatchesValueByHand) {
  // Along the row v = 240 from u = 320 to u = 420, inverse depth 0.4 to 0.6. S = (0, 0, 2) is at
  // u = 320, s = 0: 0.5 - 0.4. E = (0.4, 0, 4) is at u = 370, s = 0.5: 0.25 - 0.5.
  const LineSegment2 observed{{320.0, 240.0}, {420.0, 240.0}};
  const CostPtr cost(LineDepthReprojection::Create(camera_, observed, depth_, 0.05, 0.1));
  EXPECT_THAT(Residual(*cost, {Block(Rigid3()), {0.0, 0.0, 2.0, 0.4, 0.0, 4.0}}),
              IsNear(Eigen::Vector2d(2.0, -2.5), 1e-12));
}

TEST_P(LineDepthReprojectionTest, DerivativesMatch) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const Blocks blocks{Block(pose), Block(pose.Inverse() * InView())};
    const LineDepthReprojection factor(camera_, somewhere_, depth_, 0.003, 0.005);
    ExpectGradientsMatch(*CostPtr(LineDepthReprojection::Create(factor)), blocks);
    ExpectAnalyticMatchesAutomatic(factor, blocks);
  }
}

TEST_P(LineDepthReprojectionTest, IsInvariantToMotionOfTheWorld) {
  const Rigid3 pose = random_.Pose(), shift = random_.Pose();
  const LineSegment3 line = pose.Inverse() * InView();
  const CostPtr cost(LineDepthReprojection::Create(camera_, somewhere_, depth_, 0.003, 0.005));
  EXPECT_THAT(Residual(*cost, {Block(pose * shift.Inverse()), Block(shift * line)}),
              IsNear(Residual(*cost, {Block(pose), Block(line)}), 1e-8));
}

TEST_P(LineDepthReprojectionTest, SwappedEndPointsSwapRows) {
  const LineSegment3 line = InView();
  const Eigen::VectorXd r =
      Residual(*CostPtr(LineDepthReprojection::Create(camera_, somewhere_, depth_, 0.003, 0.005)),
               {Block(Rigid3()), Block(line)});
  const LineSegment3 swapped{line.end, line.start};
  EXPECT_THAT(
      Residual(*CostPtr(LineDepthReprojection::Create(camera_, somewhere_, depth_, 0.005, 0.003)),
               {Block(Rigid3()), Block(swapped)}),
      IsNear(Eigen::Vector2d(r[1], r[0]), 1e-9));
  // The observed segment with swapped ends, and its depth.
  const LineSegment2 observed{somewhere_.end, somewhere_.start};
  LineDepth backward = depth_;
  std::swap(backward.start, backward.end);
  EXPECT_THAT(
      Residual(*CostPtr(LineDepthReprojection::Create(camera_, observed, backward, 0.003, 0.005)),
               {Block(Rigid3()), Block(line)}),
      IsNear(r, 1e-9));
}

TEST_P(LineDepthReprojectionTest, IsInvariantToMotionAlongTheLine) {
  const LineSegment3 line = InView();
  const CostPtr cost(
      LineDepthReprojection::Create(camera_, Project(line), DepthOf(line), 0.002, 0.002));
  const LineSegment3 shifted{line.At(0.2), line.At(1.1)};
  EXPECT_THAT(Residual(*cost, {Block(Rigid3()), Block(shifted)}),
              IsNear(Eigen::Vector2d::Zero(), 1e-9));
}

TEST_P(LineDepthReprojectionTest, HasUnitVarianceUnderTheFullCovariance) {
  // The observation covers 10 % to 85 % of the map line and its depths are correlated, so the two
  // rows are extrapolated by different amounts.
  const LineSegment3 line{{-0.4, 0.1, 2.0}, {0.6, 0.3, 3.0}};
  const LineSegment3 seen{line.At(0.1), line.At(0.85)};
  const LineSegment2 segment = Project(seen);
  LineDepth depth = DepthOf(seen);
  depth.covariance << 9e-6, -4e-6, -4e-6, 4e-6;
  const double sigma_start = depth.SigmaAt(segment.Parameter(camera_.Project(line.start)));
  const double sigma_end = depth.SigmaAt(segment.Parameter(camera_.Project(line.end)));
  EXPECT_GT(sigma_start, 3e-3);  // extrapolated beyond the observed start
  const Eigen::Matrix2d root = depth.covariance.llt().matrixL();
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    LineDepth noisy = depth;
    const Eigen::Vector2d noise = root * random_.Normal2();
    noisy.start += noise.x();
    noisy.end += noise.y();
    const Eigen::VectorXd r = Residual(
        *CostPtr(LineDepthReprojection::Create(camera_, segment, noisy, sigma_start, sigma_end)),
        {Block(Rigid3()), Block(line)});
    variance += r.cwiseAbs2() / count;
  }
  // Five standard errors of a variance.
  EXPECT_THAT(variance, IsNear(Eigen::Vector2d(1.0, 1.0), 5.0 * std::sqrt(2.0 / count)));
}

TEST_P(LineDepthReprojectionTest, IsUndefinedIfAnEndPointIsBehindTheCamera) {
  const CostPtr cost(LineDepthReprojection::Create(camera_, somewhere_, depth_, 0.002, 0.002));
  EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, -1.0, 0.2, 0.1, 2.0}}));
  EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, 1.0, 0.2, 0.1, 0.0}}));
}

TEST_P(LineDepthReprojectionTest, RecoversALineFromOneViewWithReprojection) {
  const LineSegment3 truth{{-0.4, 0.1, 2.0}, {0.6, 0.3, 3.0}};
  LineSegment3 line{{-0.5, 0.15, 2.3}, {0.6, 0.2, 2.6}};
  Rigid3 pose;
  ceres::Problem problem;
  problem.AddResidualBlock(LineReprojection::Create(camera_, Project(truth), 1.0, 1.0), nullptr,
                           pose.params.data(), line.start.data());
  problem.AddResidualBlock(
      LineDepthReprojection::Create(camera_, Project(truth), DepthOf(truth), 0.002, 0.002), nullptr,
      pose.params.data(), line.start.data());
  problem.SetParameterBlockConstant(pose.params.data());
  SolveToEnd(&problem);
  // As infinite lines: positions along the line are not constrained.
  EXPECT_LT(truth.DistanceToLine(line.start), 1e-6);
  EXPECT_LT(truth.DistanceToLine(line.end), 1e-6);
}

}  // namespace
}  // namespace msc_vo
