// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/stepwise_bundle_adjustment.h"

#include <stdexcept>

#include "tests/support/test_window.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

class StepwiseBundleAdjustmentTest : public ::testing::TestWithParam<BundleAdjustmentSolver> {
 protected:
  StepwiseBundleAdjustmentTest() {
    TestWindowOptions scene;
    scene.num_points = 60;
    scene.num_lines = 15;
    scene.outlier_ratio = 0.05;
    data_ = MakeTestWindow(scene).data;
    options_.solver = GetParam();
    options_.landmark_noise.enabled = true;
  }

  BundleAdjustmentOptions options_;
  WindowData data_;
};

TEST_P(StepwiseBundleAdjustmentTest, GivesTheSameBits) {
  WindowData at_once = data_, in_slices = data_;
  const BundleAdjustmentSummary expected = LocalBundleAdjustment(options_, &at_once);
  ASSERT_TRUE(expected.usable);
  StepwiseBundleAdjustment solve(options_, &in_slices);
  int num_slices = 1;
  while (solve.Advance()) {
    ++num_slices;
    EXPECT_TRUE(SameState(in_slices, data_));  // the result is written at the end
  }
  EXPECT_TRUE(SameState(in_slices, at_once));
  EXPECT_EQ(solve.summary().BriefReport(), expected.BriefReport());
  EXPECT_EQ(solve.summary().usable, expected.usable);
  EXPECT_FALSE(solve.Advance());
  if (GetParam() != BundleAdjustmentSolver::kBlockSchur) return;
  EXPECT_GE(num_slices, expected.num_iterations);
}

TEST_P(StepwiseBundleAdjustmentTest, RefusesInvalidData) {
  data_.point_observations[0].point = 987654;
  StepwiseBundleAdjustment solve(options_, &data_);
  EXPECT_THROW(solve.Advance(), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Solvers, StepwiseBundleAdjustmentTest,
                         ::testing::Values(BundleAdjustmentSolver::kBlockSchur,
                                           BundleAdjustmentSolver::kCeres));

}  // namespace
}  // namespace msc_vo
