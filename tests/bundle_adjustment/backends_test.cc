// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// All solvers reach the same minimum.

#include <regex>

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {
namespace {

struct Variant {
  const char* name;
  BundleAdjustmentSolver solver;
};
void PrintTo(const Variant& variant, std::ostream* stream) { *stream << variant.name; }

class BundleAdjustmentSolverTest : public ::testing::TestWithParam<Variant> {
 protected:
  BundleAdjustmentSolverTest() {
    scene_.outlier_ratio = 0.05;
    scene_.max_observations = 5;
    reference_.solver = BundleAdjustmentSolver::kBlockSchur;
    options_.solver = GetParam().solver;
  }
  void SetUp() override {
    if (!IsAvailable(options_.solver))
      GTEST_SKIP() << "Ceres was built without this sparse library";
  }

  static void AddPair(int i, int j, WindowData* data) {
    WindowData::LinePair pair;
    pair.a = data->lines[i].id;
    pair.b = data->lines[j].id;
    pair.count = 1 + i % 3;
    (i % 3 == j % 3 ? data->parallel_pairs : data->perpendicular_pairs).push_back(pair);
  }
  static void AddAlignment(int i, WindowData* data) {
    WindowData::AxisAlignment alignment;
    alignment.line = data->lines[i].id;
    alignment.axis = Eigen::Vector3d::Unit(i % 3);
    data->axis_alignments.push_back(alignment);
  }

  void ExpectSameSolution(const WindowData& start) {
    WindowData expected = start, data = start;
    const BundleAdjustmentSummary a = LocalBundleAdjustment(reference_, &expected);
    const BundleAdjustmentSummary b = LocalBundleAdjustment(options_, &data);
    ASSERT_TRUE(a.usable && b.usable) << a.BriefReport() << b.BriefReport();
    EXPECT_NEAR(b.initial_cost, a.initial_cost, 1e-12 * a.initial_cost);
    EXPECT_NEAR(b.final_cost, a.final_cost, 1e-6 * a.final_cost);
    EXPECT_LT(a.final_cost, 0.5 * a.initial_cost);
    EXPECT_EQ(b.point_reprojection.num_rejected, a.point_reprojection.num_rejected);
    EXPECT_EQ(b.line_reprojection.num_rejected, a.line_reprojection.num_rejected);
    EXPECT_EQ(b.parallel.num_rejected, a.parallel.num_rejected);
    for (size_t i = 0; i < data.keyframes.size(); ++i) {
      EXPECT_LT(Distance(data.keyframes[i].cam_from_world, expected.keyframes[i].cam_from_world),
                1e-4);
    }
    // Without depth the cost is flat along some rays, where the minimum is not unique.
    for (size_t i = 0; scene_.has_depth && i < data.lines.size(); ++i) {
      EXPECT_THAT(data.lines[i].segment.end, IsNear(expected.lines[i].segment.end, 1e-3));
    }
  }

  TestWindowOptions scene_;
  BundleAdjustmentOptions options_, reference_;
};

TEST_P(BundleAdjustmentSolverTest, SolvesPointsAndLines) {
  ExpectSameSolution(MakeTestWindow(scene_).data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesLinesThatPassTheCamera) {
  WindowData data = MakeTestWindow(scene_).data;
  // Lines along the viewing direction that begin behind all cameras.
  for (size_t i = 2; i < data.lines.size(); i += 3) {
    LineSegment3& line = data.lines[i].segment;
    auto& behind = line.start.z() < line.end.z() ? line.start : line.end;
    behind -= (3.0 + behind.z()) / line.Direction().z() * line.Direction();
  }
  WindowData solved = data;
  EXPECT_EQ(LocalBundleAdjustment(options_, &solved).num_behind_camera, 0);
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesWithoutDepth) {
  scene_.has_depth = false;
  ExpectSameSolution(MakeTestWindow(scene_).data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesWithReprojectionOrDepthOnly) {
  // A step may move an outlier line without depth behind a camera, where block Schur differs from
  // Ceres (BlockSchurMinimizer).
  scene_.outlier_ratio = 0.0;
  for (BundleAdjustmentOptions* options : {&options_, &reference_}) {
    options->point_reprojection.enabled = false;
    options->line_depth.enabled = false;
  }
  WindowData data = MakeTestWindow(scene_).data;
  for (auto& point : data.points) point.fixed = true;  // depth does not constrain them laterally
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesStructuralTerms) {
  WindowData data = MakeTestWindow(scene_).data;
  // A clique, a star, a chain, lines with an alignment only, and lines without structural terms.
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) AddPair(i, j, &data);
  }
  for (int i = 7; i < 14; ++i) AddPair(6, i, &data);
  for (int i = 14; i < 20; ++i) AddPair(i, i + 1, &data);
  for (int i = 18; i < 30; ++i) AddAlignment(i, &data);
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesWithFixedLandmarksAndFixedPartners) {
  TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  for (int i : {0, 1, 5}) {
    data.lines[i] = window.truth.lines[i];
    data.points[i] = window.truth.points[i];
    data.lines[i].fixed = data.points[i].fixed = true;
  }
  for (int i = 1; i < 12; ++i) AddPair(0, i, &data);
  for (int i = 20; i < 24; ++i) AddPair(5, i, &data);
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesRegardlessOfTheOrderOfTheData) {
  WindowData data = MakeTestWindow(scene_).data;
  std::swap(data.keyframes[0], data.keyframes[7]);
  std::reverse(data.point_observations.begin(), data.point_observations.end());
  // Observed twice in one keyframe.
  data.point_observations.push_back(data.point_observations[3]);
  data.point_observations.back().pixel.x() += 0.5;
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesWithPosePriors) {
  TestWindow window = MakeTestWindow(scene_);
  WindowData data = window.data;
  for (auto& keyframe : data.keyframes) keyframe.fixed = false;
  for (const int i : {0, 1, 1, 6}) {  // one of them twice
    WindowData::PosePrior prior{data.keyframes[i].id, window.truth.keyframes[i].cam_from_world};
    prior.cam_from_world.translation().x() += 0.01 * i;
    prior.covariance.diagonal() << 1e-4, 2e-4, 1e-4, 4e-4, 4e-4, 8e-4;
    prior.covariance(0, 4) = prior.covariance(4, 0) = 1e-4;
    data.pose_priors.push_back(prior);
  }
  ExpectSameSolution(data);
}

TEST_P(BundleAdjustmentSolverTest, SolvesRepeatedAndSwappedPairs) {
  WindowData data = MakeTestWindow(scene_).data;
  for (int i = 1; i < 9; ++i) {
    AddPair(0, i, &data);
    AddPair(i, 0, &data);
    AddPair(i, 9 - i, &data);
  }
  ExpectSameSolution(data);
}

// The squared residual overflows.
TEST_P(BundleAdjustmentSolverTest, ReportsFailureWhenTheCostOverflows) {
  WindowData data = MakeTestWindow(scene_).data;
  data.point_observations[7].sigma = 1e-200;
  for (const BundleAdjustmentOptions& options : {options_, reference_}) {
    WindowData after = data;
    const BundleAdjustmentSummary summary = LocalBundleAdjustment(options, &after);
    EXPECT_FALSE(summary.usable) << summary.BriefReport();
    EXPECT_FALSE(summary.message.empty());
    EXPECT_EQ(after.points[3].position, data.points[3].position);
  }
}

TEST_P(BundleAdjustmentSolverTest, ReportsStagesInOrder) {
  const WindowData start = MakeTestWindow(scene_).data;
  for (const BundleAdjustmentOptions& options : {options_, reference_}) {
    std::string stages;
    const auto record = [&stages](WindowStage stage) {
      stages += "blswd"[static_cast<int>(stage)];  // in the order of the enum
    };
    WindowData data = start, unobserved = start;
    LocalBundleAdjustment(options, &data, record);
    const bool is_block_schur = options.solver == BundleAdjustmentSolver::kBlockSchur;
    EXPECT_TRUE(
        std::regex_match(stages, std::regex(is_block_schur ? "b(l(sl?)+b){2}wd" : "b(sb){2}wd")))
        << stages;
    LocalBundleAdjustment(options, &unobserved);
    EXPECT_EQ(data.points[5].position, unobserved.points[5].position);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, BundleAdjustmentSolverTest,
                         ::testing::Values(Variant{"Eigen", BundleAdjustmentSolver::kCeres},
                                           Variant{"SuiteSparse",
                                                   BundleAdjustmentSolver::kCeresSuiteSparse}),
                         [](const auto& variant) { return std::string(variant.param.name); });

}  // namespace
}  // namespace msc_vo
