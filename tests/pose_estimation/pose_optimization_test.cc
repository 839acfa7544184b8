// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_optimization.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/pose_estimation/window_frame.h"
#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include <Eigen/Cholesky>
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// Normalised estimation error squared: chi-square with six degrees of freedom if the covariance is
// consistent.
double Nees(const Rigid3& estimate, const PoseSummary& summary, const Rigid3& truth) {
  Eigen::Matrix<double, 6, 1> error;
  Rigid3Manifold().Minus(estimate.params.data(), truth.params.data(), error.data());
  return error.dot(summary.covariance.llt().solve(error));
}

// The parameter is fy.
class PoseOptimizationTest : public ::testing::TestWithParam<double> {
 protected:
  PoseOptimizationTest() { scene_.fy = GetParam(); }
  // The window of the scene without measurement noise.
  TestWindow ExactWindow() const {
    TestWindowOptions exact = scene_;
    exact.noise = 0.0;
    return MakeTestWindow(exact);
  }
  TestWindowOptions scene_;
};
INSTANTIATE_TEST_SUITE_P(FocalLength, PoseOptimizationTest, ::testing::Values(525.0, -480.0));

TEST_P(PoseOptimizationTest, RecoversThePoseFromExactMatches) {
  const TestWindow window = ExactWindow();
  PoseData data = MakePoseData(window, kFrame);
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(summary.num_inliers.points, 200);
  EXPECT_EQ(summary.num_inliers.lines, 40);
  EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-7);
  EXPECT_NEAR(summary.final_cost, 0.0, 1e-8);
}

TEST_P(PoseOptimizationTest, RecoversThePoseFromPixelsOfOneKind) {
  const TestWindow window = ExactWindow();
  for (const bool points : {true, false}) {
    PoseOptions options;
    options.point_reprojection.enabled = points;
    options.line_reprojection.enabled = !points;
    options.point_depth.enabled = options.line_depth.enabled = false;
    PoseData data = MakePoseData(window, kFrame);
    EXPECT_TRUE(OptimizePose(options, &data).usable) << points;
    EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-7) << points;
  }
}

TEST_P(PoseOptimizationTest, IsNotUsableWithDepthsOfPointsOnly) {
  // Depths do not constrain the rotation about the optical axis, among others.
  PoseOptions options;
  options.point_reprojection.enabled = options.line_reprojection.enabled = false;
  options.line_depth.enabled = false;
  PoseData data = MakePoseData(MakeTestWindow(scene_), kFrame);
  EXPECT_FALSE(OptimizePose(options, &data).usable);
}

TEST_P(PoseOptimizationTest, ToleratesNoiseAndOutliers) {
  scene_.outlier_ratio = 0.3;
  const TestWindow window = MakeTestWindow(scene_);
  PoseData data = MakePoseData(window, kFrame);
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  ASSERT_TRUE(summary.usable);
  // Inside the 99.9 % confidence ellipsoid of its covariance (six degrees of freedom).
  EXPECT_LT(Nees(data.cam_from_world, summary, Truth(window)), 22.46);
  EXPECT_LT(std::sqrt(summary.covariance.trace()), 0.005);
  // Compare the inlier flags with the generated outliers.
  int point = 0, line = 0, good = 0, kept = 0;
  const auto count = [&](bool wrong, bool inlier) {
    EXPECT_FALSE(wrong && inlier);
    good += !wrong;
    kept += inlier;
  };
  for (size_t i = 0; i < window.point_outliers.size(); ++i) {
    if (window.truth.point_observations[i].keyframe != window.truth.keyframes[kFrame].id) continue;
    count(window.point_outliers[i], data.points[point++].inlier);
  }
  for (size_t i = 0; i < window.line_outliers.size(); ++i) {
    if (window.truth.line_observations[i].keyframe != window.truth.keyframes[kFrame].id) continue;
    count(window.line_outliers[i], data.lines[line++].inlier);
  }
  // The chi-square test rejects 1 % of the good matches.
  EXPECT_GE(kept, 0.96 * good);
  EXPECT_EQ(kept, summary.num_inliers.points + summary.num_inliers.lines);
}

TEST_P(PoseOptimizationTest, InflatesTheSigmasOfANoisyFrame) {
  scene_.noise = 1.8;
  const TestWindow window = MakeTestWindow(scene_);
  const auto inlier_ratio = [&](double max_frame_noise) {
    PoseOptions options;
    options.max_frame_noise = max_frame_noise;
    PoseData data = MakePoseData(window, kFrame);
    const auto num_points = static_cast<double>(data.points.size());
    return OptimizePose(options, &data).num_inliers.points / num_points;
  };
  // With sigmas 1.8 times too small, 1 - exp(-9.21 / 2 / 1.8^2) = 0.76 of the points pass the test.
  EXPECT_NEAR(inlier_ratio(1.0), 0.76, 0.1);
  EXPECT_GT(inlier_ratio(2.0), 0.95);
}

TEST_P(PoseOptimizationTest, CountsConfirmedMatches) {
  PoseData data = MakePoseData(ExactWindow(), kFrame);
  int num_confirmed = 0;
  int num_confirmed_outliers = 0;
  for (size_t i = 0; i < data.points.size(); ++i) {
    data.points[i].confirmed = i % 2 == 0;
    if (i % 5 == 0) data.points[i].pixel.x() += 30.0;
    num_confirmed += i % 2 == 0;
    num_confirmed_outliers += i % 10 == 0;
  }
  for (PoseData::Line& line : data.lines) line.confirmed = false;
  data.lines.front().confirmed = true;
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  ASSERT_EQ(summary.num_dynamic, 0);
  EXPECT_EQ(summary.num_confirmed, num_confirmed + 1);
  EXPECT_EQ(summary.num_confirmed_inliers, num_confirmed - num_confirmed_outliers + 1);
}

TEST_P(PoseOptimizationTest, ReclassifiesEarlierOutliers) {
  const TestWindow window = ExactWindow();
  PoseData data = MakePoseData(window, kFrame);
  // The prediction is so wrong that many matches are outliers after a round of one iteration.
  data.cam_from_world = Moved(Truth(window), {0.03, 0.06, 0.03}, {0.1, -0.05, 0.15});
  PoseOptions options;
  options.max_frame_noise = 1.0;      // would inflate the sigmas
  options.consensus.enabled = false;  // would find the pose at once
  options.iterations_per_round = 1;
  options.num_rounds = 1;
  options.num_robust_rounds = 1;
  PoseData first = data;
  OptimizePose(options, &first);
  int num_first_inliers = 0;
  for (const auto& p : first.points) num_first_inliers += p.inlier;
  ASSERT_LT(num_first_inliers, 180);
  ASSERT_GT(num_first_inliers, 10);
  options.num_rounds = 8;
  options.num_robust_rounds = 4;
  EXPECT_EQ(OptimizePose(options, &data).num_inliers.points, 200);
  EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-6);
}

TEST_P(PoseOptimizationTest, KeepsObservationsWithAWrongDepth) {
  const TestWindow window = ExactWindow();
  PoseData data = MakePoseData(window, kFrame);
  for (int i = 0; i < 40; ++i) data.points[i].inverse_depth += 0.1;
  for (int i = 0; i < 8; ++i) data.lines[i].depth.start += 0.1;
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  EXPECT_EQ(summary.num_inliers.points, 200);
  EXPECT_EQ(summary.num_inliers.lines, 40);
  EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-7);
  EXPECT_NEAR(summary.final_cost, 0.0, 1e-8);
}

TEST_P(PoseOptimizationTest, RejectsMatchesBehindTheCamera) {
  const TestWindow window = ExactWindow();
  PoseData data = MakePoseData(window, kFrame);
  data.points[3].position.z() = -2.0;
  data.lines[5].map_segment.end.z() = -2.0;
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  EXPECT_TRUE(summary.usable);
  EXPECT_FALSE(data.points[3].inlier);
  EXPECT_FALSE(data.lines[5].inlier);
  EXPECT_EQ(summary.num_inliers.points, 199);
  EXPECT_EQ(summary.num_inliers.lines, 39);
  EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-7);
}

// Mean NEES over `runs` windows with different noise.
double MeanNees(TestWindowOptions scene, int runs) {
  double sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    scene.seed = 1000 + run;
    const TestWindow window = MakeTestWindow(scene);
    PoseData data = MakePoseData(window, kFrame);
    const PoseSummary summary = OptimizePose(PoseOptions(), &data);
    EXPECT_TRUE(summary.usable) << run;
    sum += Nees(data.cam_from_world, summary, Truth(window));
  }
  return sum / runs;
}

TEST_P(PoseOptimizationTest, HasAConsistentCovariance) {
  // 200 times the mean is chi-square with 1200 degrees of freedom: the 99 % interval of the mean is
  // 6 +- 2.576 sqrt(2 * 6 / 200).
  scene_.num_keyframes = 6;
  scene_.num_points = 60;
  scene_.num_lines = 15;
  EXPECT_NEAR(MeanNees(scene_, 200), 6.0, 0.631);
}

// Both rows of a line count as independent. The covariance is somewhat too large then, and never
// too small: for anti-correlated ends, as of a fit to many samples, and, if segments are accurate,
// for ends with a common error. With one pixel, short segments turn (docs/limitations.md).
TEST_P(PoseOptimizationTest, HasAConservativeCovarianceFromLines) {
  scene_.num_keyframes = 6;
  scene_.num_points = 0;
  scene_.num_lines = 25;
  const std::vector<std::pair<double, double>> sigmas_and_correlations = {
      {1.0, -0.4}, {0.25, -0.4}, {0.25, 0.5}, {0.25, 0.9}};
  for (const auto& [sigma, correlation] : sigmas_and_correlations) {
    scene_.line_sigma = sigma;
    scene_.line_depth_correlation = correlation;
    const double nees = MeanNees(scene_, 200);
    EXPECT_LT(nees, 6.0 + 0.631) << sigma << " pixels, " << correlation;
    EXPECT_GT(nees, 4.5) << sigma << " pixels, " << correlation;
  }
}

TEST_P(PoseOptimizationTest, IsDeterministic) {
  scene_.outlier_ratio = 0.2;
  PoseData a = MakePoseData(MakeTestWindow(scene_), kFrame);
  PoseData b = MakePoseData(MakeTestWindow(scene_), kFrame);
  ASSERT_TRUE(OptimizePose(PoseOptions(), &a).usable);
  ASSERT_TRUE(OptimizePose(PoseOptions(), &b).usable);
  EXPECT_EQ(a.cam_from_world.params, b.cam_from_world.params);
}

// Expects the unchanged prediction and a zero covariance.
void ExpectNotUsable(PoseData data) {
  const Rigid3 prediction = data.cam_from_world;
  const PoseSummary summary = OptimizePose(PoseOptions(), &data);
  EXPECT_FALSE(summary.usable);
  EXPECT_EQ(data.cam_from_world.params, prediction.params);
  EXPECT_TRUE(summary.covariance.isZero(0.0));
}

TEST_P(PoseOptimizationTest, IsNotUsableWithTooFewRows) {
  scene_.has_depth = false;
  PoseData data = MakePoseData(MakeTestWindow(scene_), kFrame);
  data.lines.clear();
  data.points.resize(2);
  ExpectNotUsable(data);
  data.points.clear();
  ExpectNotUsable(data);
}

TEST_P(PoseOptimizationTest, RecoversThePoseFromThreePointsWithDepth) {
  const TestWindow window = ExactWindow();
  PoseData data = MakePoseData(window, kFrame);
  data.lines.clear();
  data.points.resize(3);
  EXPECT_TRUE(OptimizePose(PoseOptions(), &data).usable);
  EXPECT_LT(Distance(data.cam_from_world, Truth(window)), 1e-6);
}

TEST_P(PoseOptimizationTest, IsNotUsableWithParallelLinesOnly) {
  // Lines along x do not constrain the translation along x.
  PoseData data = MakePoseData(ExactWindow(), kFrame);
  data.points.clear();
  std::vector<PoseData::Line> along_x;
  for (size_t i = 0; i < data.lines.size(); i += 3) along_x.push_back(data.lines[i]);
  data.lines = along_x;
  ASSERT_GE(data.lines.size(), 10u);
  ExpectNotUsable(data);
}

TEST_P(PoseOptimizationTest, IsNotUsableWithOneRepeatedPoint) {
  PoseData data = MakePoseData(ExactWindow(), kFrame);
  data.lines.clear();
  data.points.assign(20, data.points[0]);
  ExpectNotUsable(data);
}

TEST(PoseOptions, RejectsFrameNoiseBelowOne) {
  PoseOptions options;
  options.max_frame_noise = 0.9;
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, Names("max_frame_noise"));
}

TEST_P(PoseOptimizationTest, NamesTheInvalidMatch) {
  const PoseData good = MakePoseData(MakeTestWindow(scene_), kFrame);
  const auto message = [](PoseData data, const PoseOptions& options = PoseOptions()) {
    try {
      OptimizePose(options, &data);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PoseData bad = good;
  bad.points[7].pixel.x() = nan;
  EXPECT_THAT(message(bad), Names("point 7", "pixel", "finite"));
  bad = good;
  bad.points[8].position.z() = nan;
  EXPECT_THAT(message(bad), Names("point 8", "position", "finite"));
  bad = good;
  bad.points[9].sigma = 0.0;
  EXPECT_THAT(message(bad), Names("point 9", "sigma"));
  bad = good;
  bad.points[10].inverse_depth_sigma = 0.0;
  EXPECT_THAT(message(bad), Names("point 10", "inverse_depth_sigma"));
  bad = good;
  bad.points[10].inverse_depth = -1.0;
  EXPECT_THAT(message(bad), Names("point 10", "inverse_depth", "[0, 1e9]"));
  bad = good;
  bad.lines[3].map_segment.end = bad.lines[3].map_segment.start;
  EXPECT_THAT(message(bad), Names("line 3", "segment", "zero"));
  bad = good;
  bad.lines[4].sigma = -1.0;
  EXPECT_THAT(message(bad), Names("line 4", "sigma"));
  bad = good;
  bad.lines[5].depth.covariance.setZero();
  EXPECT_THAT(message(bad), Names("line 5", "depth", "covariance"));
  bad = good;
  bad.cam_from_world.params.setZero();
  EXPECT_THAT(message(bad), Names("prediction", "quaternion"));
  bad = good;
  bad.camera.fx = 0.0;
  EXPECT_THAT(message(bad), Names("fx"));
  PoseOptions options;
  options.num_robust_rounds = 5;
  EXPECT_THAT(message(good, options), Names("num_robust_rounds"));
  options = PoseOptions();
  options.line_depth.huber = 0.0;
  EXPECT_THAT(message(good, options), Names("huber"));
}

}  // namespace
}  // namespace msc_vo
