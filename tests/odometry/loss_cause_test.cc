// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/loss_cause.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A good image whose features do not fit the map.
FrameResult Unmatched() {
  FrameResult frame;
  frame.num_points = 800;
  frame.num_lines = 90;
  frame.num_with_depth = 700;
  frame.image = {110.0, 50.0, 0.8};
  return frame;
}

TEST(FindLossCause, ReturnsTheFirstCauseThatApplies) {
  FrameResult frame = Unmatched();
  EXPECT_EQ(FindLossCause(frame), LossCause::kNoMatch);
  frame.num_with_depth = 3;
  EXPECT_EQ(FindLossCause(frame), LossCause::kDepthOutOfRange);
  frame.image.measured_depth = 0.0;
  EXPECT_EQ(FindLossCause(frame), LossCause::kNoDepth);
  frame.num_points = frame.num_lines = 4;
  EXPECT_EQ(FindLossCause(frame), LossCause::kFewFeatures);
  frame.image.contrast = 0.5;
  EXPECT_EQ(FindLossCause(frame), LossCause::kUniformImage);
}

}  // namespace
}  // namespace msc_vo
