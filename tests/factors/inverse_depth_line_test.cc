// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/inverse_depth_line.h"

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/inverse_depth_line_pair.h"
#include "msc_vo/factors/inverse_depth_line_prior.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"

namespace msc_vo {
namespace {

using Parallel = InverseDepthLinePair<ParallelLines>;
using Perpendicular = InverseDepthLinePair<PerpendicularLines>;

// Parameter: fy, which is negative for mirrored images.
class InverseDepthLineTest : public ::testing::TestWithParam<double> {
 protected:
  InverseDepthLineTest() { camera_.fy = GetParam(); }
  // A random segment that is long in the image: numeric derivatives of short ones are inaccurate.
  LineSegment3 InView() {
    for (;;) {
      const Eigen::Vector3d start = random_.InView(), end = random_.InView();
      const LineSegment3 line{start, end};
      if (Project(line).Length() > 200.0) return line;
    }
  }
  LineSegment2 Project(const LineSegment3& line) const {
    return {camera_.Project(line.start), camera_.Project(line.end)};
  }
  static LineDepth DepthOf(const LineSegment3& line) {
    LineDepth depth;
    depth.start = 1.0 / line.start.z();
    depth.end = 1.0 / line.end.z();
    depth.covariance << 4e-6, -1e-6, -1e-6, 9e-6;
    return depth;
  }
  InverseDepthLine Observe(const LineSegment3& line) const {
    return InverseDepthLine(camera_, Project(line), DepthOf(line), 1.0, 0.005);
  }
  static std::vector<double> BlockOf(const LineSegment3& line, double a = 0.0, double c = 0.0) {
    return {1.0 / line.start.z(), 1.0 / line.end.z(), a, c};
  }
  Eigen::Vector3d Direction(const InverseDepthLine& line, const std::vector<double>& block) const {
    Eigen::Vector3d d;
    EXPECT_TRUE(line.Direction(block.data(), &d));
    return d;
  }
  PinholeCamera camera_;
  RandomGeometry random_{1};
};
INSTANTIATE_TEST_SUITE_P(FocalLength, InverseDepthLineTest, ::testing::Values(525.0, -480.0));

TEST_P(InverseDepthLineTest, DirectionMatchesTheSegmentAtAnyDepth) {
  for (int i = 0; i < 10; ++i) {
    const LineSegment3 line = InView();
    const InverseDepthLine inverse_depth_line = Observe(line);
    EXPECT_THAT(Direction(inverse_depth_line, BlockOf(line)), IsNear(line.Direction(), 1e-12));
    const LineSegment3 other{1.3 * line.start, 0.8 * line.end};  // on the same rays
    EXPECT_THAT(Direction(inverse_depth_line, BlockOf(other)), IsNear(other.Direction(), 1e-12));
  }
}

TEST_P(InverseDepthLineTest, DeviationsRotateTheLineInAndOutOfTheInterpretationPlane) {
  const LineSegment3 line = InView();
  const InverseDepthLine inverse_depth_line = Observe(line);
  const Eigen::Vector3d normal = line.start.cross(line.end).normalized();
  const Eigen::Vector3d in_plane = Direction(inverse_depth_line, BlockOf(line, 1.0, 0.0));
  EXPECT_NEAR(in_plane.dot(normal), 0.0, 1e-12);
  EXPECT_NEAR(in_plane.cross(line.Direction()).norm(), std::sin(std::atan(0.005)), 1e-9);
  const Eigen::Vector3d out = Direction(inverse_depth_line, BlockOf(line, 0.0, 1.0));
  EXPECT_NEAR(out.dot(normal),
              std::sin(std::atan(std::hypot(0.005, inverse_depth_line.image_angle()))), 1e-9);
}

TEST_P(InverseDepthLineTest, ImageAngleMatchesPixelNoise) {
  // Both end points shifted across the image segment by normal deviates of 0.1 px.
  const LineSegment3 line{{-0.4, 0.1, 2.0}, {0.2, 0.3, 3.0}};
  const LineSegment2 observed = Project(line);
  const Eigen::Vector2d d = observed.Direction(), across(-d.y(), d.x());
  const Eigen::Vector3d normal = line.start.cross(line.end).normalized();
  double variance = 0.0;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d noise = 0.1 * random_.Normal2();
    const LineSegment2 noisy{observed.start + noise.x() * across,
                             observed.end + noise.y() * across};
    const double out = BackProject(camera_, noisy, DepthOf(line)).Direction().dot(normal);
    variance += out * out / count;
  }
  const double expected =
      std::pow(InverseDepthLine(camera_, observed, DepthOf(line), 0.1, 0.005).image_angle(), 2);
  EXPECT_NEAR(variance, expected, 5.0 * expected * std::sqrt(2.0 / count));
}

TEST_P(InverseDepthLineTest, PairsMatchTheRelationsOfTheirDirections) {
  const LineSegment3 a = InView(), b = InView();
  const Eigen::Vector3d cross = a.Direction().cross(b.Direction());
  EXPECT_THAT(
      Residual(*CostPtr(Parallel::Create(Observe(a), Observe(b), 0.1)), {BlockOf(a), BlockOf(b)}),
      IsNear((10.0 * cross).eval(), 1e-9));
  EXPECT_NEAR(Residual(*CostPtr(Perpendicular::Create(Observe(a), Observe(b), 0.1)),
                       {BlockOf(a), BlockOf(b)})[0],
              10.0 * a.Direction().dot(b.Direction()), 1e-9);
}

TEST_P(InverseDepthLineTest, DerivativesMatch) {
  for (int i = 0; i < 10; ++i) {
    const LineSegment3 a = InView(), b = InView();
    const Blocks blocks{BlockOf(a, 0.3, -0.8), BlockOf(b, -0.2, 1.1)};
    ExpectGradientsMatch(*CostPtr(Parallel::Create(Observe(a), Observe(b), 0.01)), blocks);
    ExpectGradientsMatch(*CostPtr(Perpendicular::Create(Observe(a), Observe(b), 0.01)), blocks);
    ExpectGradientsMatch(*CostPtr(InverseDepthLinePrior::Create(DepthOf(a))), {blocks[0]});
  }
}

TEST_P(InverseDepthLineTest, DerivativesMatchAtParallelOppositeAndPerpendicular) {
  const LineSegment3 a{{-0.5, 0.2, 2.0}, {0.3, 0.2, 2.5}};
  const Eigen::Vector3d d = a.end - a.start, start(0.1, -0.3, 3.0);
  for (const Eigen::Vector3d& other : {d, Eigen::Vector3d(-d), Eigen::Vector3d(0.1, 0.5, -0.16)}) {
    const LineSegment3 b{start, start + other};
    const Blocks blocks{BlockOf(a), BlockOf(b)};
    ExpectGradientsMatch(*CostPtr(Parallel::Create(Observe(a), Observe(b), 0.01)), blocks);
    ExpectGradientsMatch(*CostPtr(Perpendicular::Create(Observe(a), Observe(b), 0.01)), blocks);
  }
}

TEST_P(InverseDepthLineTest, IsUndefinedWithoutADirection) {
  const LineSegment3 a = InView();
  EXPECT_FALSE(IsDefined(*CostPtr(Parallel::Create(Observe(a), Observe(a), 0.01)),
                         {{0.0, 0.0, 0.0, 0.0}, BlockOf(a)}));
}

TEST_P(InverseDepthLineTest, PriorIsZeroAtTheFitAndHasUnitCovariance) {
  const LineSegment3 line = InView();
  const LineDepth depth = DepthOf(line);
  const CostPtr cost(InverseDepthLinePrior::Create(depth));
  EXPECT_THAT(Residual(*cost, {BlockOf(line)}), IsNear(Eigen::Vector4d::Zero(), 1e-12));
  const Eigen::Matrix2d root = depth.covariance.llt().matrixL();
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d w = root * random_.Normal2(), deviates = random_.Normal2();
    samples.push_back(
        Residual(*cost, {{depth.start + w.x(), depth.end + w.y(), deviates.x(), deviates.y()}}));
  }
  ExpectIdentityCovariance(samples);
}

TEST_P(InverseDepthLineTest, StructureCorrectsThePoorlyFittedLine) {
  // The two lines differ by a few degrees; the covariances of their priors decide which one
  // rotates.
  const LineSegment3 good{{-0.5, 0.2, 2.0}, {0.3, 0.2, 2.5}};
  const LineSegment3 truth{{-0.4, -0.3, 2.4}, {0.4, -0.3, 2.9}};
  const LineSegment3 poor{truth.start, 1.02 * truth.end};  // on the same rays
  LineDepth good_depth = DepthOf(good), poor_depth = DepthOf(poor);
  good_depth.covariance *= 1e-2;
  poor_depth.covariance *= 1e2;
  std::vector<double> a = BlockOf(good), b = BlockOf(poor);
  const InverseDepthLine line_a(camera_, Project(good), good_depth, 0.1, 1e-4);
  const InverseDepthLine line_b(camera_, Project(poor), poor_depth, 0.1, 1e-4);
  ceres::Problem problem;
  problem.AddResidualBlock(Parallel::Create(line_a, line_b, 1e-3), nullptr, a.data(), b.data());
  problem.AddResidualBlock(InverseDepthLinePrior::Create(good_depth), nullptr, a.data());
  problem.AddResidualBlock(InverseDepthLinePrior::Create(poor_depth), nullptr, b.data());
  SolveToEnd(&problem);
  EXPECT_GT(poor.Direction().cross(good.Direction()).norm(), 0.03);
  EXPECT_LT(Direction(line_a, a).cross(good.Direction()).norm(), 1e-3);
  EXPECT_LT(Direction(line_b, b).cross(good.Direction()).norm(), 1e-3);
}

}  // namespace
}  // namespace msc_vo
