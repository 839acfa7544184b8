// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// All solvers of the window go the same way, to the same minimum.

#include <regex>

#include "tests/support/factor_checks.h"
#include "tests/support/synthetic_window.h"

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {
namespace {

struct Variant {
  const char* name;
  BundleAdjustmentSolver solver;
  bool analytic_jacobians = true;
  bool explicit_ordering = true;
};
void PrintTo(const Variant& variant, std::ostream* stream) { *stream << variant.name; }

class WindowSolversTest : public ::testing::TestWithParam<Variant> {
 protected:
  WindowSolversTest() {
    scene_.wrong_ratio = 0.05;
    scene_.max_observations = 5;
    reference_.solver = BundleAdjustmentSolver::kBlockSchur;
    options_.solver = GetParam().solver;
    options_.analytic_jacobians = GetParam().analytic_jacobians;
    options_.explicit_ordering = GetParam().explicit_ordering;
  }
  void SetUp() override {
    if (!IsAvailable(options_.solver)) GTEST_SKIP() << "this Ceres has no such sparse library";
  }

  // Line i of the window lies along axis i % 3.
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
    EXPECT_EQ(b.num_iterations, a.num_iterations);
    EXPECT_EQ(b.point_reprojection.num_rejected, a.point_reprojection.num_rejected);
    EXPECT_EQ(b.line_reprojection.num_rejected, a.line_reprojection.num_rejected);
    EXPECT_EQ(b.parallel.num_rejected, a.parallel.num_rejected);
    for (size_t i = 0; i < data.keyframes.size(); ++i) {
      EXPECT_LT(Distance(data.keyframes[i].cam_from_world, expected.keyframes[i].cam_from_world),
                1e-4);
    }
    // Without depth the cost is flat along some rays, and convergence stops anywhere there.
    for (size_t i = 0; scene_.has_depth && i < data.lines.size(); ++i) {
      EXPECT_THAT(data.lines[i].segment.end, IsNear(expected.lines[i].segment.end, 1e-3));
    }
  }

  SyntheticWindowOptions scene_;
  BundleAdjustmentOptions options_, reference_;
};

TEST_P(WindowSolversTest, PointsAndLines) { ExpectSameSolution(MakeSyntheticWindow(scene_).data); }

TEST_P(WindowSolversTest, WithoutDepth) {
  scene_.has_depth = false;
  ExpectSameSolution(MakeSyntheticWindow(scene_).data);
}

TEST_P(WindowSolversTest, OneTermOfEachObservation) {
  // A wrong line without depth may be taken behind a camera, where block Schur goes its own way
  // (MinimizeWindow).
  scene_.wrong_ratio = 0.0;
  for (BundleAdjustmentOptions* options : {&options_, &reference_}) {
    options->point_reprojection.enabled = false;  // depth alone holds nothing across: all but
    options->line_depth.enabled = false;          // points come from lines
  }
  WindowData data = MakeSyntheticWindow(scene_).data;
  for (auto& point : data.points) point.fixed = true;
  ExpectSameSolution(data);
}

TEST_P(WindowSolversTest, Structure) {
  WindowData data = MakeSyntheticWindow(scene_).data;
  // A clique, a star, a chain, lines that are only aligned, and lines alone.
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) AddPair(i, j, &data);
  }
  for (int i = 7; i < 14; ++i) AddPair(6, i, &data);
  for (int i = 14; i < 20; ++i) AddPair(i, i + 1, &data);
  for (int i = 18; i < 30; ++i) AddAlignment(i, &data);
  ExpectSameSolution(data);
}

TEST_P(WindowSolversTest, FixedPartnersAndFixedLandmarks) {
  SyntheticWindow window = MakeSyntheticWindow(scene_);
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

TEST_P(WindowSolversTest, AFreeKeyframeMayBeAnywhereInTheOrder) {
  WindowData data = MakeSyntheticWindow(scene_).data;
  std::swap(data.keyframes[0], data.keyframes[7]);
  std::reverse(data.point_observations.begin(), data.point_observations.end());
  // Seen twice in one keyframe.
  data.point_observations.push_back(data.point_observations[3]);
  data.point_observations.back().pixel.x() += 0.5;
  ExpectSameSolution(data);
}

TEST_P(WindowSolversTest, Priors) {
  SyntheticWindow window = MakeSyntheticWindow(scene_);
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

TEST_P(WindowSolversTest, PairsMayRepeatEitherWayAround) {
  WindowData data = MakeSyntheticWindow(scene_).data;
  for (int i = 1; i < 9; ++i) {
    AddPair(0, i, &data);
    AddPair(i, 0, &data);
    AddPair(i, 9 - i, &data);
  }
  ExpectSameSolution(data);
}

// An error of so many sigmas that its square is not finite.
TEST_P(WindowSolversTest, ACostThatOverflowsIsNotUsable) {
  WindowData data = MakeSyntheticWindow(scene_).data;
  data.point_observations[7].sigma = 1e-200;
  for (const BundleAdjustmentOptions& options : {options_, reference_}) {
    WindowData after = data;
    const BundleAdjustmentSummary summary = LocalBundleAdjustment(options, &after);
    EXPECT_FALSE(summary.usable) << summary.BriefReport();
    EXPECT_FALSE(summary.message.empty());
    EXPECT_EQ(after.points[3].position, data.points[3].position);
  }
}

TEST_P(WindowSolversTest, TellsItsStagesInTheirOrder) {
  const WindowData start = MakeSyntheticWindow(scene_).data;
  for (const BundleAdjustmentOptions& options : {options_, reference_}) {
    std::string stages;
    const auto note = [&stages](WindowStage stage) {
      stages += "blswd"[static_cast<int>(stage)];  // in the order of the enum
    };
    WindowData data = start, unobserved = start;
    LocalBundleAdjustment(options, &data, note);
    const bool own = options.solver == BundleAdjustmentSolver::kBlockSchur;
    EXPECT_TRUE(std::regex_match(stages, std::regex(own ? "b(l(sl?)+b){2}wd" : "b(sb){2}wd")))
        << stages;
    LocalBundleAdjustment(options, &unobserved);
    EXPECT_EQ(data.points[5].position, unobserved.points[5].position);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Solvers, WindowSolversTest,
    ::testing::Values(
        Variant{"DenseSchur", BundleAdjustmentSolver::kCeresDenseSchur},
        Variant{"AutomaticDerivatives", BundleAdjustmentSolver::kCeresDenseSchur, false},
        Variant{"AutomaticOrdering", BundleAdjustmentSolver::kCeresDenseSchur, true, false},
        Variant{"SuiteSparse", BundleAdjustmentSolver::kCeresSuiteSparse},
        Variant{"EigenSparse", BundleAdjustmentSolver::kCeresEigenSparse}),
    [](const auto& variant) { return std::string(variant.param.name); });

}  // namespace
}  // namespace msc_vo
