// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_problem.h"

#include <algorithm>
#include <memory>

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <ceres/loss_function.h>
#include <ceres/solver.h>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {
namespace {

class WindowProblemTest : public ::testing::Test {
 protected:
  WindowProblemTest() {
    TestWindowOptions scene;
    scene.num_keyframes = 5;
    scene.num_fixed = 2;
    scene.num_points = 12;
    scene.num_lines = 4;
    scene.max_observations = 3;
    window_ = MakeTestWindow(scene);
    data_ = window_.data;
    inlier_mask_.points.assign(data_.point_observations.size(), {true, true});
    inlier_mask_.lines.assign(data_.line_observations.size(), {true, true});
  }

  std::unique_ptr<WindowProblem> Build() {
    state_ = std::make_unique<WindowState>(data_);
    terms_ =
        MakeWindowTerms(options_, data_, ValidateWindow(options_, data_), inlier_mask_, *state_);
    return std::make_unique<WindowProblem>(options_, data_, terms_, state_.get());
  }
  bool IsConstant(WindowProblem* window, const double* block) {
    return window->problem()->IsParameterBlockConstant(block);
  }

  BundleAdjustmentOptions options_;
  TestWindow window_;
  WindowData data_;
  std::unique_ptr<WindowState> state_;
  WindowTerms terms_;
  WindowInlierMask inlier_mask_;
};

TEST_F(WindowProblemTest, BuildsOneResidualBlockPerFactor) {
  const auto window = Build();
  EXPECT_EQ(terms_.Of<PointReprojection>().blocks.size(), 36u);
  EXPECT_EQ(terms_.Of<DepthReprojection>().blocks.size(), 36u);
  EXPECT_EQ(terms_.Of<LineReprojection>().blocks.size(), 12u);
  EXPECT_EQ(terms_.Of<LineDepthReprojection>().blocks.size(), 12u);
  EXPECT_EQ(terms_.Of<LineEndpointPrior>().blocks.size(), 4u);
  const ceres::Problem& problem = *window->problem();
  EXPECT_EQ(problem.NumResidualBlocks(), 36 + 36 + 12 + 12 + 4);
  EXPECT_EQ(problem.NumResiduals(), 36 * (2 + 1) + 12 * (2 + 2) + 4 * 2);
  EXPECT_EQ(problem.NumParameterBlocks(), 5 + 12 + 4);
  EXPECT_EQ(problem.NumParameters(), 5 * 7 + 12 * 3 + 4 * 6);
}

TEST_F(WindowProblemTest, ExcludesOutliersAndDisabledTerms) {
  inlier_mask_.points[5] = {false, false};
  inlier_mask_.points[6] = {true, false};
  inlier_mask_.lines[2] = {true, false};
  options_.line_reprojection.enabled = false;
  Build();
  EXPECT_EQ(terms_.Of<PointReprojection>().blocks.size(), 35u);
  EXPECT_EQ(terms_.Of<DepthReprojection>().blocks.size(), 34u);
  EXPECT_EQ(terms_.Of<LineReprojection>().blocks.size(), 0u);
  EXPECT_EQ(terms_.Of<LineDepthReprojection>().blocks.size(), 11u);
}

TEST_F(WindowProblemTest, HoldsFixedBlocksConstantAndPosesOnTheManifold) {
  data_.points[1].fixed = true;
  data_.lines[2].fixed = true;
  const auto window = Build();
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    const double* pose = state_->PoseBlock(i);
    EXPECT_EQ(IsConstant(window.get(), pose), i < 2) << i;
    EXPECT_EQ(window->problem()->ParameterBlockTangentSize(pose), 6);
  }
  for (size_t i = 0; i < data_.points.size(); ++i) {
    EXPECT_EQ(IsConstant(window.get(), state_->PointBlock(i)), i == 1) << i;
  }
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    EXPECT_EQ(IsConstant(window.get(), state_->LineBlock(i)), i == 2) << i;
  }
  EXPECT_EQ(terms_.Of<LineEndpointPrior>().blocks.size(), 3u);  // none for the fixed line
}

TEST_F(WindowProblemTest, EliminatesLandmarksBeforePoses) {
  const auto window = Build();
  const auto ordering = window->EliminationOrdering();
  EXPECT_EQ(ordering->NumElements(), 21);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(ordering->GroupId(state_->PointBlock(i)), 0);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(ordering->GroupId(state_->LineBlock(i)), 0);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(ordering->GroupId(state_->PoseBlock(i)), 1);
}

TEST_F(WindowProblemTest, TermCostsMatchCeres) {
  const auto window = Build();
  const double sum = Cost(terms_.Of<PointReprojection>(), *state_) +
                     Cost(terms_.Of<DepthReprojection>(), *state_) +
                     Cost(terms_.Of<LineReprojection>(), *state_) +
                     Cost(terms_.Of<LineDepthReprojection>(), *state_) +
                     Cost(terms_.Of<LineEndpointPrior>(), *state_);
  double ceres = 0.0;
  ASSERT_TRUE(window->problem()->Evaluate({}, &ceres, nullptr, nullptr, nullptr));
  EXPECT_NEAR(sum, ceres, 1e-9 * ceres);
  EXPECT_GT(Cost(terms_.Of<LineDepthReprojection>(), *state_), 0.0);
}

TEST_F(WindowProblemTest, ChiSquareExcludesTheLoss) {
  // An error of one pixel in each coordinate: 1 + 1 for any threshold.
  data_ = window_.truth;
  data_.point_observations[0].pixel =
      data_.camera.Project(data_.keyframes[0].cam_from_world * data_.points[0].position) +
      Eigen::Vector2d(1.0, 1.0);
  data_.point_observations[0].keyframe = data_.keyframes[0].id;
  data_.point_observations[0].point = data_.points[0].id;
  options_.point_reprojection.huber = 0.1;
  Build();
  EXPECT_NEAR(ChiSquare<PointReprojection>(terms_.Of<PointReprojection>().blocks[0], *state_), 2.0,
              1e-9);
}

TEST_F(WindowProblemTest, EndpointPriorsAreCentredAtTheInitialLines) {
  Build();
  const Eigen::Vector3d along = 0.1 * data_.lines[0].segment.Direction();
  for (int i = 0; i < 3; ++i) state_->LineBlock(0)[i] += along[i];
  // The line moved along its initial direction.
  EXPECT_NEAR(ChiSquare<LineEndpointPrior>(terms_.Of<LineEndpointPrior>().blocks[0], *state_),
              std::pow(0.1 / options_.line_endpoint_prior_sigma, 2), 1e-9);
  EXPECT_NEAR(ChiSquare<LineEndpointPrior>(terms_.Of<LineEndpointPrior>().blocks[1], *state_), 0.0,
              1e-12);
}

// Height of a keyframe: (t_z - height) / sigma, with t of cam_from_world.
struct Height : CostFunctor<Height, 1, 7> {
  explicit Height(double h) : height(h) {}
  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    residual[0] = (pose[6] - height) / 1e-6;
    return true;
  }
  double height;
};

// Offset of two points, a block of the caller's own: (y - x - own) / sigma.
struct Offset : CostFunctor<Offset, 3, 3, 3, 3> {
  template <typename T>
  bool operator()(const T* x, const T* y, const T* own, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = (y[i] - x[i] - own[i]) / 1e-3;
    return true;
  }
};

TEST_F(WindowProblemTest, SolvesAWindowAsLocalBundleAdjustmentDoes) {
  // Without outliers, and without lines, whose sigmas follow the state, both solves of
  // LocalBundleAdjustment have the same problem.
  data_.lines.clear();
  data_.line_observations.clear();
  WindowData expected = data_, data = data_;
  options_.solver = BundleAdjustmentSolver::kCeres;
  options_.reject_chi2_2 = options_.reject_chi2_3 = options_.reject_chi2_4 = 1e9;
  options_.first_iterations = options_.second_iterations = 50;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &expected).usable);
  WindowProblem window(options_, data);
  ceres::Solver::Options solver_options = window.SolverOptions(50);
  solver_options.function_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, window.problem(), &summary);
  EXPECT_LT(summary.final_cost, 0.5 * summary.initial_cost);
  window.WriteBack(&data);
  for (size_t i = 0; i < data.keyframes.size(); ++i) {
    EXPECT_LT(Distance(data.keyframes[i].cam_from_world, expected.keyframes[i].cam_from_world),
              1e-4);
  }
  for (size_t i = 0; i < data.points.size(); ++i) {
    EXPECT_THAT(data.points[i].position, IsNear(expected.points[i].position, 1e-3));
  }
}

TEST_F(WindowProblemTest, FindsBlocksByKindAndId) {
  data_.axes.emplace();
  data_.extra_blocks.push_back({3, Eigen::Vector2d(4.0, 5.0)});
  WindowProblem window(options_, data_);
  const auto expect = [&](const BlockId& block, const double* values, int size) {
    const double* found = window.Block(block);
    EXPECT_TRUE(std::equal(found, found + size, values));
    EXPECT_TRUE(window.problem()->HasParameterBlock(found));
    EXPECT_EQ(window.problem()->ParameterBlockSize(found), size);
  };
  expect(BlockId::Pose(data_.keyframes[2].id), data_.keyframes[2].cam_from_world.params.data(), 7);
  expect(BlockId::Point(data_.points[5].id), data_.points[5].position.data(), 3);
  expect(BlockId::Line(data_.lines[1].id), data_.lines[1].segment.start.data(), 6);
  expect(BlockId::Axes(), data_.axes->world_from_axes.coeffs().data(), 4);
  expect(BlockId::Extra(3), data_.extra_blocks[0].value.data(), 2);
  // Three numbers are not always a point: the id of a point is none of an extra block.
  EXPECT_THROW(window.Block(BlockId::Extra(data_.points[5].id + 1000)), std::invalid_argument);
  EXPECT_THROW(window.Block(BlockId::Pose(-1)), std::invalid_argument);
  data_.axes.reset();
  EXPECT_THROW(WindowProblem(options_, data_).Block(BlockId::Axes()), std::invalid_argument);
}

// A pose of the window, two points that are otherwise eliminated, and a block of the caller's own.
TEST_F(WindowProblemTest, IsExtendedByResidualBlocks) {
  WindowProblem window(options_, data_);
  double* const pose = window.Block(BlockId::Pose(data_.keyframes.back().id));
  double* const a = window.Block(BlockId::Point(data_.points[0].id));
  double* const b = window.Block(BlockId::Point(data_.points[1].id));
  const double height = pose[6] + 0.05;
  window.AddResidualBlock(Height::Create(height), nullptr, {pose});
  double own[3] = {0.0, 0.0, 0.0};
  window.AddResidualBlock(Offset::Create(), new ceres::HuberLoss(1.0), {a, b, own});
  const auto ordering = window.EliminationOrdering();
  EXPECT_EQ(ordering->NumElements(), window.problem()->NumParameterBlocks());
  for (double* block : {a, b, own, pose}) EXPECT_EQ(ordering->GroupId(block), 1);
  ceres::Solver::Summary summary;
  ceres::Solve(window.SolverOptions(50), window.problem(), &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
  EXPECT_NEAR(pose[6], height, 1e-4);
  EXPECT_NEAR(own[1], b[1] - a[1], 1e-5);
  window.WriteBack(&data_);
  EXPECT_EQ(data_.keyframes.back().cam_from_world.translation().z(), pose[6]);
}

TEST_F(WindowProblemTest, LeavesOutWhatIsRejected) {
  const int all = WindowProblem(options_, data_).problem()->NumResidualBlocks();
  data_.point_observations[4].rejected = true;
  data_.line_observations[2].rejected = true;
  data_.point_observations[5].depth_rejected = true;
  data_.line_observations[3].depth_rejected = true;
  EXPECT_EQ(WindowProblem(options_, data_).problem()->NumResidualBlocks(), all - 6);
}

// Also where only the depth of an observation is an outlier.
TEST_F(WindowProblemTest, HasTheInliersOfASolvedWindow) {
  for (size_t i = 0; i < data_.point_observations.size(); i += 9) {
    data_.point_observations[i].inverse_depth *= 0.7;
  }
  data_.line_observations[4].depth.start *= 0.7;
  data_.line_observations[4].depth.end *= 0.7;
  const auto count_marks = [](const auto& observations) {
    return std::count_if(observations.begin(), observations.end(),
                         [](const auto& o) { return o.depth_rejected; });
  };
  for (const bool consensus : {false, true}) {
    SCOPED_TRACE(consensus);
    options_.consensus.enabled = consensus;
    WindowData solved = data_;
    const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &solved);
    ASSERT_TRUE(summary.usable);
    EXPECT_GE(summary.point_depth.num_rejected, 4);
    EXPECT_EQ(count_marks(solved.point_observations), summary.point_depth.num_rejected);
    EXPECT_EQ(count_marks(solved.line_observations), summary.line_depth.num_rejected);
    EXPECT_TRUE(solved.line_observations[4].depth_rejected);
    int num_inliers = 0;
    for (const auto& [name, term] : summary.Terms()) num_inliers += term->num_residual_blocks;
    EXPECT_EQ(WindowProblem(options_, solved).problem()->NumResidualBlocks(), num_inliers);
  }
}

TEST_F(WindowProblemTest, WritesNothingThatIsNotValidAndToNoOtherWindow) {
  WindowProblem window(options_, data_);
  WindowData other = data_;
  other.points.pop_back();
  EXPECT_THROW(window.WriteBack(&other), std::invalid_argument);
  window.Block(BlockId::Point(data_.points[0].id))[0] = std::nan("");
  WindowData after = data_;
  EXPECT_THROW(window.WriteBack(&after), std::runtime_error);
  EXPECT_EQ(after.points[0].position, data_.points[0].position);
}

}  // namespace
}  // namespace msc_vo
