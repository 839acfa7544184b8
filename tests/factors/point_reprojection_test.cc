// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/factors/point_reprojection.h"

#include "tests/support/factor_checks.h"

namespace msc_vo {
namespace {

// Parameter: fy, which is negative for mirrored images.
class PointReprojectionTest : public ::testing::TestWithParam<double> {
 protected:
  PointReprojectionTest() {
    camera_.fx = 500.0;
    camera_.fy = GetParam();
    camera_.cx = 320.0;
    camera_.cy = 240.0;
  }
  PinholeCamera camera_;
  RandomGeometry random_{1};
};
INSTANTIATE_TEST_SUITE_P(FocalLength, PointReprojectionTest, ::testing::Values(400.0, -400.0));

TEST_P(PointReprojectionTest, IsZeroAtTruth) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const Eigen::Vector3d x = random_.InView();
    const CostPtr cost(PointReprojection::Create(camera_, camera_.Project(x), 1.5));
    EXPECT_THAT(Residual(*cost, {Block(pose), Block(pose.Inverse() * x)}),
                IsNear(Eigen::Vector2d::Zero(), 1e-9));
  }
}

TEST_P(PointReprojectionTest, MatchesValueByHand) {
  // x = (0.2, -0.1, 2) projects to u = 500 * 0.1 + 320 and v = +-400 * -0.05 + 240.
  const double v = camera_.fy > 0.0 ? 220.0 : 260.0;
  const CostPtr cost(PointReprojection::Create(camera_, Eigen::Vector2d(368.0, v + 3.0), 2.0));
  const Rigid3 pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  EXPECT_THAT(Residual(*cost, {Block(pose), {0.2, -0.1, 0.5}}),
              IsNear(Eigen::Vector2d(1.0, -1.5), 1e-12));
}

TEST_P(PointReprojectionTest, DerivativesMatch) {
  for (int i = 0; i < 10; ++i) {
    const Rigid3 pose = random_.Pose();
    const Blocks blocks{Block(pose), Block(pose.Inverse() * random_.InView())};
    const PointReprojection factor(camera_, {300.0, 200.0}, 1.2);
    ExpectGradientsMatch(*CostPtr(PointReprojection::Create(factor)), blocks);
    ExpectAnalyticMatchesAutomatic(factor, blocks);
  }
}

TEST_P(PointReprojectionTest, IsInvariantToMotionOfTheWorld) {
  const Rigid3 pose = random_.Pose(), shift = random_.Pose();
  const Eigen::Vector3d x = pose.Inverse() * random_.InView();
  const CostPtr cost(PointReprojection::Create(camera_, Eigen::Vector2d(300.0, 200.0), 1.2));
  EXPECT_THAT(Residual(*cost, {Block(pose * shift.Inverse()), Block(shift * x)}),
              IsNear(Residual(*cost, {Block(pose), Block(x)}), 1e-9));
}

TEST_P(PointReprojectionTest, HasUnitCovarianceUnderItsNoise) {
  const Eigen::Vector3d x(0.3, -0.2, 2.0);
  const double sigma = 1.7;
  std::vector<Eigen::VectorXd> samples;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d pixel = camera_.Project(x) + sigma * random_.Normal2();
    samples.push_back(Residual(*CostPtr(PointReprojection::Create(camera_, pixel, sigma)),
                               {Block(Rigid3()), Block(x)}));
  }
  ExpectIdentityCovariance(samples);
}

TEST_P(PointReprojectionTest, IsUndefinedBehindTheCamera) {
  const PointReprojection factor(camera_, {300.0, 200.0}, 1.0);
  const CostPtr cost(PointReprojection::Create(factor));
  const AnalyticCostFunction<PointReprojection> analytic(factor);
  for (const double z : {-1.0, 0.0, 0.009}) {
    EXPECT_FALSE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, z}})) << z;
    EXPECT_FALSE(IsDefined(analytic, {Block(Rigid3()), {0.0, 0.0, z}})) << z;
  }
  EXPECT_TRUE(IsDefined(*cost, {Block(Rigid3()), {0.0, 0.0, 0.011}}));
}

TEST_P(PointReprojectionTest, RecoversAPose) {
  const Rigid3 truth = random_.Pose();
  Rigid3 pose = Moved(truth, {0.1, -0.05, 0.1}, {0.1, 0.2, -0.1});
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i) points.push_back(truth.Inverse() * random_.InView());
  ceres::Problem problem;
  problem.AddParameterBlock(pose.params.data(), 7, new Rigid3Manifold);
  for (Eigen::Vector3d& x : points) {
    problem.AddResidualBlock(PointReprojection::Create(camera_, camera_.Project(truth * x), 1.0),
                             nullptr, pose.params.data(), x.data());
    problem.SetParameterBlockConstant(x.data());
  }
  SolveToEnd(&problem);
  EXPECT_LT(Distance(pose, truth), 1e-9);
}

}  // namespace
}  // namespace msc_vo
