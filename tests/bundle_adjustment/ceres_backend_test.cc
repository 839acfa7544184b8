// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"

#include <memory>

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"

namespace msc_vo {
namespace {

class CeresBackendTest : public ::testing::Test {
 protected:
  CeresBackendTest() {
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

  std::unique_ptr<CeresBackend> Build() {
    state_ = std::make_unique<WindowState>(data_);
    terms_ =
        MakeWindowTerms(options_, data_, ValidateWindow(options_, data_), inlier_mask_, *state_);
    return std::make_unique<CeresBackend>(options_, data_, terms_, state_.get());
  }
  bool IsConstant(CeresBackend* window, const double* block) {
    return window->problem()->IsParameterBlockConstant(block);
  }

  BundleAdjustmentOptions options_;
  TestWindow window_;
  WindowData data_;
  std::unique_ptr<WindowState> state_;
  WindowTerms terms_;
  WindowInlierMask inlier_mask_;
};

TEST_F(CeresBackendTest, BuildsOneResidualBlockPerObservation) {
  const auto window = Build();
  EXPECT_EQ(terms_.point_reprojection.blocks.size(), 36u);
  EXPECT_EQ(terms_.point_depth.blocks.size(), 36u);
  EXPECT_EQ(terms_.line_reprojection.blocks.size(), 12u);
  EXPECT_EQ(terms_.line_depth.blocks.size(), 12u);
  EXPECT_EQ(terms_.line_endpoint_prior.blocks.size(), 4u);
  const ceres::Problem& problem = *window->problem();
  EXPECT_EQ(problem.NumResidualBlocks(), 36 + 12 + 4);
  EXPECT_EQ(problem.NumResiduals(), 36 * (2 + 1 + 1) + 12 * (2 + 2 + 1) + 4 * 2);
  EXPECT_EQ(problem.NumParameterBlocks(), 5 + 12 + 4);
  EXPECT_EQ(problem.NumParameters(), 5 * 7 + 12 * 3 + 4 * 6);
}

TEST_F(CeresBackendTest, BuildsOneResidualBlockPerFactorWithAutomaticDerivatives) {
  options_.analytic_jacobians = false;
  const auto window = Build();
  EXPECT_EQ(window->problem()->NumResidualBlocks(), 36 + 36 + 12 + 12 + 4);
  EXPECT_EQ(window->problem()->NumResiduals(), 36 * (2 + 1) + 12 * (2 + 2) + 4 * 2);
}

TEST_F(CeresBackendTest, BuildsBlocksOfObservationsWithOneFactor) {
  inlier_mask_.points[0] = {true, false};
  inlier_mask_.points[7] = {false, true};
  inlier_mask_.points[35] = {false, true};
  inlier_mask_.lines[11] = {true, false};
  const auto window = Build();
  EXPECT_EQ(window->problem()->NumResidualBlocks(), 36 + 12 + 4);
  EXPECT_EQ(window->problem()->NumResiduals(), 33 * 4 + 2 + 1 + 1 + 11 * 5 + 2 + 4 * 2);
  double cost = 0.0;
  ASSERT_TRUE(window->problem()->Evaluate({}, &cost, nullptr, nullptr, nullptr));
  EXPECT_NEAR(cost, Cost(terms_, *state_), 1e-9 * cost);
}

TEST_F(CeresBackendTest, ExcludesOutliersAndDisabledTerms) {
  inlier_mask_.points[5] = {false, false};
  inlier_mask_.points[6] = {true, false};
  inlier_mask_.lines[2] = {true, false};
  options_.line_reprojection.enabled = false;
  Build();
  EXPECT_EQ(terms_.point_reprojection.blocks.size(), 35u);
  EXPECT_EQ(terms_.point_depth.blocks.size(), 34u);
  EXPECT_EQ(terms_.line_reprojection.blocks.size(), 0u);
  EXPECT_EQ(terms_.line_depth.blocks.size(), 11u);
}

TEST_F(CeresBackendTest, HoldsFixedBlocksConstantAndPosesOnTheManifold) {
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
  EXPECT_EQ(terms_.line_endpoint_prior.blocks.size(), 3u);  // none for the fixed line
}

TEST_F(CeresBackendTest, EliminatesLandmarksBeforePoses) {
  const auto window = Build();
  const auto ordering = window->EliminationOrdering();
  EXPECT_EQ(ordering->NumElements(), 21);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(ordering->GroupId(state_->PointBlock(i)), 0);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(ordering->GroupId(state_->LineBlock(i)), 0);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(ordering->GroupId(state_->PoseBlock(i)), 1);
}

TEST_F(CeresBackendTest, TermCostsMatchCeres) {
  const auto window = Build();
  const double sum = Cost(terms_.point_reprojection, *state_) + Cost(terms_.point_depth, *state_) +
                     Cost(terms_.line_reprojection, *state_) + Cost(terms_.line_depth, *state_) +
                     Cost(terms_.line_endpoint_prior, *state_);
  double ceres = 0.0;
  ASSERT_TRUE(window->problem()->Evaluate({}, &ceres, nullptr, nullptr, nullptr));
  EXPECT_NEAR(sum, ceres, 1e-9 * ceres);
  EXPECT_GT(Cost(terms_.line_depth, *state_), 0.0);
}

TEST_F(CeresBackendTest, ChiSquareExcludesTheLoss) {
  // An error of one pixel in each coordinate: 1 + 1 for any threshold.
  data_ = window_.truth;
  data_.point_observations[0].pixel =
      data_.camera.Project(data_.keyframes[0].cam_from_world * data_.points[0].position) +
      Eigen::Vector2d(1.0, 1.0);
  data_.point_observations[0].keyframe = data_.keyframes[0].id;
  data_.point_observations[0].point = data_.points[0].id;
  options_.point_reprojection.huber = 0.1;
  Build();
  EXPECT_NEAR(ChiSquare<PointReprojection>(terms_.point_reprojection.blocks[0], *state_), 2.0,
              1e-9);
}

TEST_F(CeresBackendTest, EndpointPriorsAreCentredAtTheInitialLines) {
  Build();
  const Eigen::Vector3d along = 0.1 * data_.lines[0].segment.Direction();
  for (int i = 0; i < 3; ++i) state_->LineBlock(0)[i] += along[i];
  // The line moved along its initial direction.
  EXPECT_NEAR(ChiSquare<LineEndpointPrior>(terms_.line_endpoint_prior.blocks[0], *state_),
              std::pow(0.1 / options_.line_endpoint_prior_sigma, 2), 1e-9);
  EXPECT_NEAR(ChiSquare<LineEndpointPrior>(terms_.line_endpoint_prior.blocks[1], *state_), 0.0,
              1e-12);
}

}  // namespace
}  // namespace msc_vo
