// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/window_builder.h"

#include <memory>

#include "tests/support/factor_checks.h"
#include "tests/support/synthetic_window.h"

namespace msc_vo {
namespace {

class WindowBuilderTest : public ::testing::Test {
 protected:
  WindowBuilderTest() {
    SyntheticWindowOptions scene;
    scene.num_keyframes = 5;
    scene.num_fixed = 2;
    scene.num_points = 12;
    scene.num_lines = 4;
    scene.max_observations = 3;
    window_ = MakeSyntheticWindow(scene);
    data_ = window_.data;
    activity_.points.assign(data_.point_observations.size(), {true, true});
    activity_.lines.assign(data_.line_observations.size(), {true, true});
  }

  std::unique_ptr<WindowBuilder> Build() {
    index_ = ValidateWindow(options_, data_);
    state_ = std::make_unique<WindowState>(data_);
    return std::make_unique<WindowBuilder>(options_, data_, index_, activity_, state_.get());
  }
  bool IsConstant(WindowBuilder* builder, const double* block) {
    return builder->problem()->IsParameterBlockConstant(block);
  }

  WindowOptions options_;
  SyntheticWindow window_;
  WindowData data_;
  WindowIndex index_;
  std::unique_ptr<WindowState> state_;
  WindowActivity activity_;
};

TEST_F(WindowBuilderTest, CountsOfBlocksAndResiduals) {
  const auto builder = Build();
  EXPECT_EQ(builder->point_reprojection.blocks.size(), 36u);
  EXPECT_EQ(builder->point_depth.blocks.size(), 36u);
  EXPECT_EQ(builder->line_reprojection.blocks.size(), 12u);
  EXPECT_EQ(builder->line_depth.blocks.size(), 12u);
  EXPECT_EQ(builder->line_anchor.blocks.size(), 4u);
  const ceres::Problem& problem = *builder->problem();
  EXPECT_EQ(problem.NumResidualBlocks(), 36 + 36 + 12 + 12 + 4);
  EXPECT_EQ(problem.NumResiduals(), 36 * (2 + 1) + 12 * (2 + 2) + 4 * 2);
  EXPECT_EQ(problem.NumParameterBlocks(), 5 + 12 + 4);
  EXPECT_EQ(problem.NumParameters(), 5 * 7 + 12 * 3 + 4 * 6);
}

TEST_F(WindowBuilderTest, InactiveObservationsAndDisabledTermsAddNothing) {
  activity_.points[5] = {false, false};
  activity_.points[6] = {true, false};
  activity_.lines[2] = {true, false};
  options_.line_reprojection.enabled = false;
  const auto builder = Build();
  EXPECT_EQ(builder->point_reprojection.blocks.size(), 35u);
  EXPECT_EQ(builder->point_depth.blocks.size(), 34u);
  EXPECT_EQ(builder->line_reprojection.blocks.size(), 0u);
  EXPECT_EQ(builder->line_depth.blocks.size(), 11u);
}

TEST_F(WindowBuilderTest, FixedBlocksAreConstantAndPosesMoveOnTheManifold) {
  data_.points[1].fixed = true;
  data_.lines[2].fixed = true;
  const auto builder = Build();
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    const double* pose = state_->PoseBlock(i);
    EXPECT_EQ(IsConstant(builder.get(), pose), i < 2) << i;
    EXPECT_EQ(builder->problem()->ParameterBlockTangentSize(pose), 6);
  }
  for (size_t i = 0; i < data_.points.size(); ++i) {
    EXPECT_EQ(IsConstant(builder.get(), state_->PointBlock(i)), i == 1) << i;
  }
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    EXPECT_EQ(IsConstant(builder.get(), state_->LineBlock(i)), i == 2) << i;
  }
  EXPECT_EQ(builder->line_anchor.blocks.size(), 3u);  // a fixed line needs none
}

TEST_F(WindowBuilderTest, LandmarksAreEliminatedBeforePoses) {
  const auto builder = Build();
  const auto ordering = builder->EliminationOrdering();
  EXPECT_EQ(ordering->NumElements(), 21);
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(ordering->GroupId(state_->PointBlock(i)), 0);
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(ordering->GroupId(state_->LineBlock(i)), 0);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(ordering->GroupId(state_->PoseBlock(i)), 1);
}

TEST_F(WindowBuilderTest, CostsOfTheTermsAreThoseOfCeres) {
  const auto builder = Build();
  const double sum = builder->point_reprojection.Cost() + builder->point_depth.Cost() +
                     builder->line_reprojection.Cost() + builder->line_depth.Cost() +
                     builder->line_anchor.Cost();
  double ceres = 0.0;
  ASSERT_TRUE(builder->problem()->Evaluate({}, &ceres, nullptr, nullptr, nullptr));
  EXPECT_NEAR(sum, ceres, 1e-9 * ceres);
  EXPECT_GT(builder->line_depth.Cost(), 0.0);
}

TEST_F(WindowBuilderTest, ChiSquareIsBeforeTheLoss) {
  // One pixel off in each coordinate at the truth, hence 1 + 1, whatever the threshold.
  data_ = window_.truth;
  data_.point_observations[0].pixel =
      data_.camera.Project(data_.keyframes[0].cam_from_world * data_.points[0].position) +
      Eigen::Vector2d(1.0, 1.0);
  data_.point_observations[0].keyframe = data_.keyframes[0].id;
  data_.point_observations[0].point = data_.points[0].id;
  options_.point_reprojection.huber = 0.1;
  EXPECT_NEAR(Build()->point_reprojection.ChiSquares()[0], 2.0, 1e-9);
}

TEST_F(WindowBuilderTest, AnchorsHoldTheInitialLinesNotTheCurrentOnes) {
  const auto builder = Build();
  const Eigen::Vector3d along = 0.1 * data_.lines[0].segment.Direction();
  for (int i = 0; i < 3; ++i) state_->LineBlock(0)[i] += along[i];
  // (0.1 m / 0.05 m)^2: the motion is along the initial direction.
  EXPECT_NEAR(builder->line_anchor.ChiSquares()[0], 4.0, 1e-9);
  EXPECT_NEAR(builder->line_anchor.ChiSquares()[1], 0.0, 1e-12);
}

}  // namespace
}  // namespace msc_vo
