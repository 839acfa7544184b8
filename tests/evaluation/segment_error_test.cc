// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/evaluation/curved_path.h"
#include <gmock/gmock.h>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

TEST(EvaluateSegments, AlignsEachSegmentByItself) {
  const std::vector<TimedPose> truth = CurvedPath(40, 10.0);
  std::vector<TimedPose> estimate = truth;
  const Rigid3 jump(ExpSO3({0.0, 0.0, 1.0}), {5.0, 0.0, 0.0});
  for (int i = 20; i < 40; ++i) {
    estimate[i].world_from_cam = jump * estimate[i].world_from_cam;
    estimate[i].segment = estimate[i].world = 1;
  }
  EXPECT_GT(EvaluateTrajectory(truth, estimate).ape.rmse, 0.5);
  const std::vector<SegmentError> errors = EvaluateSegments(truth, estimate);
  ASSERT_EQ(errors.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(errors[i].segment, i);
    EXPECT_EQ(errors[i].world, i);
    EXPECT_EQ(errors[i].error.num_matched, 20);
    EXPECT_LT(errors[i].error.ape.rmse, 1e-9);
  }
  EXPECT_TRUE(HasSeveralWorlds(estimate));
}

TEST(EvaluateSegments, IsEmptyForOneSegment) {
  const std::vector<TimedPose> truth = CurvedPath(10, 10.0);
  EXPECT_TRUE(EvaluateSegments(truth, truth).empty());
  EXPECT_FALSE(HasSeveralWorlds(truth));
  EXPECT_FALSE(HasSeveralWorlds({}));
}

TEST(EvaluateSegments, NamesASegmentWithTooFewPoses) {
  const std::vector<TimedPose> truth = CurvedPath(10, 10.0);
  std::vector<TimedPose> estimate = truth;
  estimate.back().segment = 1;
  const std::vector<SegmentError> errors = EvaluateSegments(truth, estimate);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_TRUE(errors[0].error.usable);
  EXPECT_FALSE(errors[1].error.usable);
}

}  // namespace
}  // namespace msc_vo
