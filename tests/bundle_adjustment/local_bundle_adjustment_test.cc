// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

#include <stdexcept>

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

double WorstPose(const WindowData& a, const WindowData& b) {
  double worst = 0.0;
  for (size_t i = 0; i < a.keyframes.size(); ++i) {
    worst = std::max(worst, Distance(a.keyframes[i].cam_from_world, b.keyframes[i].cam_from_world));
  }
  return worst;
}

double RmsPoint(const WindowData& a, const WindowData& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.points.size(); ++i) {
    sum += (a.points[i].position - b.points[i].position).squaredNorm();
  }
  return std::sqrt(sum / double(a.points.size()));
}

// RMS distance of the estimated end points to the true infinite lines.
double RmsLine(const WindowData& truth, const WindowData& solved) {
  double sum = 0.0;
  for (size_t i = 0; i < truth.lines.size(); ++i) {
    const LineSegment3& line = truth.lines[i].segment;
    sum += std::pow(line.DistanceToLine(solved.lines[i].segment.start), 2) +
           std::pow(line.DistanceToLine(solved.lines[i].segment.end), 2);
  }
  return std::sqrt(sum / double(2 * truth.lines.size()));
}

// The parameter is fy.
class LocalBundleAdjustmentTest : public ::testing::TestWithParam<double> {
 protected:
  LocalBundleAdjustmentTest() {
    scene_.fy = GetParam();
    options_.second_iterations = 30;
  }
  TestWindowOptions scene_;
  BundleAdjustmentOptions options_;
};
INSTANTIATE_TEST_SUITE_P(FocalLength, LocalBundleAdjustmentTest, ::testing::Values(525.0, -480.0));

TEST_P(LocalBundleAdjustmentTest, RecoversTheTruthFromExactObservations) {
  scene_.noise = 0.0;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_EQ(summary.point_reprojection.num_rejected, 0) << summary.BriefReport();
  EXPECT_EQ(summary.line_reprojection.num_rejected, 0);
  EXPECT_LT(WorstPose(window.truth, data), 1e-5);
  EXPECT_LT(RmsPoint(window.truth, data), 1e-5);
  EXPECT_LT(RmsLine(window.truth, data), 1e-5);
  EXPECT_LT(summary.final_cost, 1e-3);
}

TEST_P(LocalBundleAdjustmentTest, RejectsOutliersInNoisyObservations) {
  scene_.outlier_ratio = 0.08;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_LT(WorstPose(window.truth, data), 0.008);
  EXPECT_LT(RmsPoint(window.truth, data), 0.012);
  EXPECT_LT(RmsLine(window.truth, data), 0.012);
  int outliers_kept = 0, inliers = 0, inliers_lost = 0, outliers = 0;
  const auto count = [&](bool is_outlier, bool rejected) {
    outliers += is_outlier;
    inliers += !is_outlier;
    outliers_kept += is_outlier && !rejected;
    inliers_lost += !is_outlier && rejected;
  };
  for (size_t i = 0; i < window.point_outliers.size(); ++i) {
    count(window.point_outliers[i], data.point_observations[i].rejected);
  }
  for (size_t i = 0; i < window.line_outliers.size(); ++i) {
    count(window.line_outliers[i], data.line_observations[i].rejected);
  }
  EXPECT_GT(outliers, 100);
  EXPECT_EQ(outliers_kept, 0);
  EXPECT_LT(inliers_lost, 0.02 * inliers);  // 1 % at the chi-square quantile
  EXPECT_EQ(summary.point_reprojection.num_rejected + summary.line_reprojection.num_rejected,
            outliers - outliers_kept + inliers_lost);
}

TEST_P(LocalBundleAdjustmentTest, FixedKeyframesFixTheScaleWithoutDepth) {
  scene_.noise = 0.0;
  scene_.has_depth = false;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_EQ(summary.point_depth.num_residual_blocks, 0);
  EXPECT_EQ(summary.line_depth.num_residual_blocks, 0);
  EXPECT_LT(WorstPose(window.truth, data), 1e-3);
}

TEST_P(LocalBundleAdjustmentTest, SummaryCountsResidualBlocksAndCosts) {
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  const BundleAdjustmentSummary s = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(s.usable);
  EXPECT_EQ(s.point_reprojection.num_residual_blocks + s.point_reprojection.num_rejected, 2000);
  // A rejected observation also loses its depth.
  EXPECT_EQ(s.point_depth.num_residual_blocks + s.point_depth.num_rejected +
                s.point_reprojection.num_rejected,
            2000);
  EXPECT_EQ(s.line_reprojection.num_residual_blocks + s.line_reprojection.num_rejected, 400);
  EXPECT_EQ(s.line_depth.num_residual_blocks + s.line_depth.num_rejected +
                s.line_reprojection.num_rejected,
            400);
  EXPECT_EQ(s.line_endpoint_prior.num_residual_blocks, 40);
  const auto sum = [&](double TermSummary::*cost) {
    return s.point_reprojection.*cost + s.point_depth.*cost + s.line_reprojection.*cost +
           s.line_depth.*cost + s.line_endpoint_prior.*cost;
  };
  EXPECT_DOUBLE_EQ(sum(&TermSummary::initial_cost), s.initial_cost);
  EXPECT_DOUBLE_EQ(sum(&TermSummary::final_cost), s.final_cost);
  EXPECT_LT(s.final_cost, 0.1 * s.initial_cost);
  // About half the redundancy: 6000 + 1600 rows minus 48 + 600 + 160 unknowns.
  EXPECT_NEAR(s.final_cost, 3396.0, 500.0);
  EXPECT_GT(s.num_iterations, 2);
  EXPECT_FALSE(s.schur_structure.empty());
  EXPECT_THAT(s.BriefReport(), ::testing::HasSubstr("line reprojection"));
}

TEST_P(LocalBundleAdjustmentTest, MovesFreeBlocksOnly) {
  TestWindow window = MakeTestWindow(scene_);
  window.data.points[7].fixed = true;
  window.data.lines[9].fixed = true;
  WindowData data = window.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  for (size_t i = 0; i < data.keyframes.size(); ++i) {
    EXPECT_EQ(
        data.keyframes[i].cam_from_world.params == window.data.keyframes[i].cam_from_world.params,
        data.keyframes[i].fixed)
        << i;
  }
  for (size_t i = 0; i < data.points.size(); ++i) {
    EXPECT_EQ(data.points[i].position == window.data.points[i].position, i == 7) << i;
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    EXPECT_EQ(data.lines[i].segment.start == window.data.lines[i].segment.start, i == 9) << i;
    EXPECT_EQ(data.lines[i].segment.end == window.data.lines[i].segment.end, i == 9) << i;
  }
}

TEST_P(LocalBundleAdjustmentTest, RefinesLandmarksWithAllKeyframesFixed) {
  scene_.num_fixed = scene_.num_keyframes;
  scene_.noise = 0.0;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  EXPECT_LT(RmsPoint(window.truth, data), 1e-5);
  EXPECT_LT(RmsLine(window.truth, data), 1e-5);
}

TEST_P(LocalBundleAdjustmentTest, RefinesKeyframesWithAllLandmarksFixed) {
  scene_.noise = 0.0;
  TestWindow window = MakeTestWindow(scene_);
  window.data.points = window.truth.points;
  window.data.lines = window.truth.lines;
  for (auto& p : window.data.points) p.fixed = true;
  for (auto& l : window.data.lines) l.fixed = true;
  WindowData data = window.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  EXPECT_LT(WorstPose(window.truth, data), 1e-6);
}

TEST_P(LocalBundleAdjustmentTest, ChangesNothingWithoutObservationsOrFreeBlocks) {
  TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  data.point_observations.clear();
  data.line_observations.clear();
  EXPECT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  EXPECT_TRUE(SameState(data, window.data));
  data = window.data;
  for (auto& k : data.keyframes) k.fixed = true;
  for (auto& p : data.points) p.fixed = true;
  for (auto& l : data.lines) l.fixed = true;
  EXPECT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  EXPECT_TRUE(SameState(data, window.data));
}

TEST_P(LocalBundleAdjustmentTest, RejectsAndCountsObservationsBehindTheCamera) {
  scene_.noise = 0.0;
  TestWindow window = MakeTestWindow(scene_);
  window.data.points[3].position.z() = -3.0;
  LineSegment3& line = window.data.lines[5].segment;
  line.start.z() = line.end.z() = -3.0;
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.num_behind_camera, 20);
  EXPECT_EQ(summary.point_reprojection.num_rejected, 0);
  for (const auto& o : data.point_observations) {
    EXPECT_EQ(o.rejected, o.point == data.points[3].id);
  }
  for (const auto& o : data.line_observations) EXPECT_EQ(o.rejected, o.line == data.lines[5].id);
  EXPECT_EQ(data.points[3].position, window.data.points[3].position);
  EXPECT_EQ(data.lines[5].segment.end, window.data.lines[5].segment.end);
  EXPECT_LT(WorstPose(window.truth, data), 1e-5);
}

TEST_P(LocalBundleAdjustmentTest, ALandmarkWithoutInliersKeepsItsValue) {
  scene_.noise = 0.0;
  TestWindow window = MakeTestWindow(scene_);
  // Observations that no point position explains.
  int i = 0;
  for (auto& o : window.data.point_observations) {
    if (o.point != window.data.points[3].id) continue;
    o.pixel += 60.0 * Eigen::Vector2d(std::cos(2.4 * i), std::sin(2.4 * i));
    ++i;
  }
  WindowData data = window.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  for (const auto& o : data.point_observations) {
    EXPECT_EQ(o.rejected, o.point == data.points[3].id);
  }
  EXPECT_EQ(data.points[3].position, window.data.points[3].position);
  EXPECT_LT(WorstPose(window.truth, data), 1e-4);
}

// From three times its distance, the first step moves a point without depth behind the cameras.
TEST_P(LocalBundleAdjustmentTest, ALandmarkMovedBehindACameraDoesNotRejectTheStep) {
  TestWindow window = MakeTestWindow(scene_);
  WindowData::Point& far = window.data.points[3];
  const Eigen::Vector3d center = window.truth.keyframes[0].cam_from_world.Inverse().translation();
  far.position = center + 3.0 * (far.position - center);
  for (auto& o : window.data.point_observations) {
    if (o.point == far.id) o.inverse_depth = 0.0;
  }
  options_.first_iterations = options_.second_iterations = 1;
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_LT(WorstPose(window.truth, data), 0.2 * WorstPose(window.truth, window.data));
}

// Observations do not constrain that motion.
TEST_P(LocalBundleAdjustmentTest, EndpointPriorLimitsMotionAlongTheLine) {
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  for (size_t i = 0; i < data.lines.size(); ++i) {
    const LineSegment3 &before = window.data.lines[i].segment, &after = data.lines[i].segment;
    EXPECT_LT(std::abs((after.start - before.start).dot(before.Direction())), 0.01);
    EXPECT_LT(std::abs((after.end - before.end).dot(before.Direction())), 0.01);
  }
}

TEST_P(LocalBundleAdjustmentTest, RejectsAnInconsistentDepthAlone) {
  scene_.noise = 0.0;
  TestWindow window = MakeTestWindow(scene_);
  window.data.point_observations[11].inverse_depth += 0.1;
  window.data.line_observations[13].depth.end += 0.1;
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.point_depth.num_rejected, 1);
  EXPECT_EQ(summary.line_depth.num_rejected, 1);
  EXPECT_EQ(summary.point_reprojection.num_rejected, 0);
  EXPECT_EQ(summary.line_reprojection.num_rejected, 0);
  EXPECT_FALSE(data.point_observations[11].rejected);
  EXPECT_FALSE(data.line_observations[13].rejected);
  EXPECT_LT(WorstPose(window.truth, data), 1e-5);
}

TEST_P(LocalBundleAdjustmentTest, IgnoresEarlierRejectionMarks) {
  scene_.noise = 0.0;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  for (auto& o : data.point_observations) o.rejected = true;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data).usable);
  for (const auto& o : data.point_observations) EXPECT_FALSE(o.rejected);
}

TEST_P(LocalBundleAdjustmentTest, DisabledTermsAreExcluded) {
  const TestWindow window = MakeTestWindow(scene_);
  options_.line_reprojection.enabled = options_.line_depth.enabled = false;
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.line_reprojection.num_residual_blocks, 0);
  EXPECT_EQ(summary.line_depth.num_residual_blocks, 0);
  EXPECT_EQ(summary.line_endpoint_prior.num_residual_blocks, 0);
  for (size_t i = 0; i < data.lines.size(); ++i) {
    EXPECT_EQ(data.lines[i].segment.start, window.data.lines[i].segment.start);
  }
}

TEST_P(LocalBundleAdjustmentTest, FailureLeavesTheDataUnchanged) {
  TestWindow window = MakeTestWindow(scene_);
  window.data.point_observations[5].pixel.x() += 3.0;  // its square overflows
  window.data.point_observations[5].sigma = 1e-200;
  WindowData data = window.data;
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data);
  EXPECT_FALSE(summary.usable);
  EXPECT_FALSE(summary.message.empty());
  EXPECT_TRUE(SameState(data, window.data));
}

TEST_P(LocalBundleAdjustmentTest, IsDeterministic) {
  scene_.outlier_ratio = 0.05;
  const TestWindow window = MakeTestWindow(scene_);
  WindowData a = window.data, b = window.data;
  LocalBundleAdjustment(options_, &a);
  LocalBundleAdjustment(options_, &b);
  EXPECT_TRUE(SameState(a, b));
  EXPECT_FALSE(SameState(a, window.data));
}

TEST_P(LocalBundleAdjustmentTest, InvalidInputThrowsAndLeavesTheDataUnchanged) {
  const TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  data.point_observations[0].sigma = 0.0;
  EXPECT_THROW(LocalBundleAdjustment(options_, &data), std::invalid_argument);
  EXPECT_TRUE(SameState(data, window.data));
}

}  // namespace
}  // namespace msc_vo
