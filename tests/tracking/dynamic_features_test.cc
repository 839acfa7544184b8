// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// One point and one line in each of the two cells of the image.
class DynamicFeaturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.columns = 2;
    options_.rows = 1;
    auto frame = std::make_shared<Frame>();
    frame->camera.width = 200;
    frame->camera.height = 100;
    frame->points.resize(2);
    frame->points[0].pixel = {50.0, 50.0};
    frame->points[1].pixel = {150.0, 50.0};
    frame->lines.resize(2);
    frame->lines[0].segment = {{20.0, 10.0}, {170.0, 10.0}};  // midpoint in the left cell
    frame->lines[1].segment = {{120.0, 10.0}, {170.0, 10.0}};
    tracked_.frame = frame;
  }

  CellConsensusOptions options_;
  TrackedFrame tracked_;
};

TEST_F(DynamicFeaturesTest, MarksFeaturesInDynamicCells) {
  tracked_.dynamic_cells = {true, false};
  const auto marked = MarkDynamicFeatures(options_, tracked_);
  EXPECT_TRUE(marked->points[0].dynamic);
  EXPECT_FALSE(marked->points[1].dynamic);
  EXPECT_TRUE(marked->lines[0].dynamic);
  EXPECT_FALSE(marked->lines[1].dynamic);
  EXPECT_FALSE(tracked_.frame->points[0].dynamic);  // the original frame is shared
}

TEST_F(DynamicFeaturesTest, KeepsInliersOfThePoseStatic) {
  tracked_.dynamic_cells = {true, true};
  tracked_.matches.points.resize(1);
  tracked_.matches.lines.resize(1);
  tracked_.matches.lines[0].feature = 1;
  const auto marked = MarkDynamicFeatures(options_, tracked_);
  EXPECT_FALSE(marked->points[0].dynamic);
  EXPECT_TRUE(marked->points[1].dynamic);
  EXPECT_TRUE(marked->lines[0].dynamic);
  EXPECT_FALSE(marked->lines[1].dynamic);
}

TEST_F(DynamicFeaturesTest, ReturnsTheSameFrameWithoutDynamicCells) {
  EXPECT_EQ(MarkDynamicFeatures(options_, tracked_), tracked_.frame);
}

}  // namespace
}  // namespace msc_vo
