// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include <vector>

#include <gtest/gtest.h>

#include "msc_vo/pose_estimation/cell_consensus.h"

namespace msc_vo {
namespace {

// One point and one line in each half of the image.
class DynamicFeaturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto frame = std::make_shared<Frame>();
    frame->camera.width = 200;
    frame->camera.height = 100;
    frame->points.resize(2);
    frame->points[0].pixel = {50.0, 50.0};
    frame->points[1].pixel = {150.0, 50.0};
    frame->lines.resize(2);
    frame->lines[0].segment = {{20.0, 10.0}, {170.0, 10.0}};  // midpoint in the left half
    frame->lines[1].segment = {{120.0, 10.0}, {170.0, 10.0}};
    tracked_.frame = frame;
  }

  // One flag per cell of the image: those of its left and of its right half.
  std::vector<bool> DynamicHalves(bool left, bool right) const {
    const ImageGrid grid = ConsensusGrid(tracked_.frame->camera);
    std::vector<bool> cells;
    for (int cell = 0; cell < grid.size(); ++cell) {
      cells.push_back(grid.CenterOf(cell).x() < 0.5 ? left : right);
    }
    return cells;
  }

  Map map_;
  TrackedFrame tracked_;
};

TEST_F(DynamicFeaturesTest, MarksFeaturesInDynamicCells) {
  tracked_.pose.dynamic_cells = DynamicHalves(true, false);
  const auto marked = MarkDynamicFeatures({}, map_, tracked_);
  EXPECT_TRUE(marked->points[0].dynamic);
  EXPECT_FALSE(marked->points[1].dynamic);
  EXPECT_TRUE(marked->lines[0].dynamic);
  EXPECT_FALSE(marked->lines[1].dynamic);
  EXPECT_FALSE(tracked_.frame->points[0].dynamic);  // the original frame is shared
}

TEST_F(DynamicFeaturesTest, KeepsInliersOfThePoseStatic) {
  tracked_.pose.dynamic_cells = DynamicHalves(true, true);
  tracked_.matches.points.resize(1);
  tracked_.matches.lines.resize(1);
  tracked_.matches.lines[0].feature = 1;
  const auto marked = MarkDynamicFeatures({}, map_, tracked_);
  EXPECT_FALSE(marked->points[0].dynamic);
  EXPECT_TRUE(marked->points[1].dynamic);
  EXPECT_TRUE(marked->lines[0].dynamic);
  EXPECT_FALSE(marked->lines[1].dynamic);
}

TEST_F(DynamicFeaturesTest, ReturnsTheSameFrameWithoutDynamicCells) {
  EXPECT_EQ(MarkDynamicFeatures({}, map_, tracked_), tracked_.frame);
}

// A keyframe shows a wall at 3 metres; where its image has no depth, nothing is known. Then a board
// stands at 1 metre in columns 8 to 23 of the depth ranges.
class FreeSpaceTest : public ::testing::Test {
 protected:
  static constexpr double kWall = 1.0 / 3.0, kBoard = 1.0;  // 1/metres

  void SetUp() override {
    auto before = std::make_shared<Frame>();
    before->camera = {160.0, 160.0, 160.0, 120.0, 320, 240};
    SetColumns(0, 31, kWall, before.get());
    auto now = std::make_shared<Frame>(*before);
    for (int column = 0; column < 12; ++column) SetColumns(column, column, 0.0, before.get());
    SetColumns(8, 23, kBoard, now.get());
    AddPoint(15.0, kWall, now.get());    // 0: unknown
    AddPoint(95.0, kBoard, now.get());   // 1: where the keyframe has no depth
    AddPoint(175.0, kBoard, now.get());  // 2: in free space
    AddPoint(205.0, kBoard, now.get());  // 3: in free space
    AddPoint(225.0, kBoard, now.get());  // 4: in free space
    AddPoint(205.0, kWall, now.get());   // 5: in a hole of the board
    AddPoint(295.0, kWall, now.get());   // 6
    before->points = now->points;        // which landmark it is does not matter
    tracked_.reference = map_.AddKeyframe(before, Rigid3());
    tracked_.frame = now;
  }
  static void SetColumns(int first, int last, double inverse_depth, Frame* frame) {
    frame->depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
    const auto inverse = static_cast<float>(inverse_depth);
    for (int row = 0; row < DepthRanges::kRows; ++row) {
      for (int column = first; column <= last; ++column) {
        frame->depth_ranges.cells[row * DepthRanges::kColumns + column] = {inverse, inverse};
      }
    }
  }
  static void AddPoint(double x, double inverse_depth, Frame* frame) {
    PointFeature point;
    point.pixel = {x, 115.0};
    point.inverse_depth = inverse_depth;
    point.inverse_depth_sigma = 1e-3;
    frame->points.push_back(point);
  }
  std::vector<bool> Marks() const {
    std::vector<bool> marks;
    const auto frame = MarkDynamicFeatures({}, map_, tracked_);
    for (const PointFeature& point : frame->points) {
      marks.push_back(point.dynamic);
    }
    return marks;
  }

  Map map_;
  TrackedFrame tracked_;
};

TEST_F(FreeSpaceTest, MarksASurfaceThatWasLookedThrough) {
  EXPECT_EQ(Marks(), std::vector<bool>({false, true, true, true, true, false, false}));
}

TEST_F(FreeSpaceTest, RemovesTheDepthRangesOfSuchASurface) {
  const auto marked = MarkDynamicFeatures({}, map_, tracked_);
  EXPECT_TRUE(marked->depth_ranges.At(7, 10).HasDepth());
  EXPECT_FALSE(marked->depth_ranges.At(8, 10).HasDepth());
  EXPECT_FALSE(marked->depth_ranges.At(23, 10).HasDepth());
  EXPECT_TRUE(marked->depth_ranges.At(24, 10).HasDepth());
}

// Only what is in free space is dynamic on a surface that is static otherwise.
TEST_F(FreeSpaceTest, KeepsWhatIsUnknownOnAStaticSurface) {
  tracked_.matches.points.resize(2);
  tracked_.matches.points[0].feature = 2;
  tracked_.matches.points[1].feature = 3;
  EXPECT_EQ(Marks(), std::vector<bool>({false, false, false, false, true, false, false}));
}

TEST_F(FreeSpaceTest, BelievesMostOfTheKeyframes) {
  const LandmarkId shared = map_.Add<PointLandmark>(0, 0, Eigen::Vector3d::UnitZ());
  auto with_board = std::make_shared<Frame>(*map_.FindKeyframe(0)->frame);
  SetColumns(8, 23, kBoard, with_board.get());
  for (int i = 0; i < 2; ++i)
    map_.Observe<PointLandmark>(shared, map_.AddKeyframe(with_board, Rigid3()), 0);
  EXPECT_EQ(MarkDynamicFeatures({}, map_, tracked_), tracked_.frame);
}

TEST_F(FreeSpaceTest, NeedsACertainDepth) {
  auto now = std::make_shared<Frame>(*tracked_.frame);
  for (PointFeature& point : now->points) point.inverse_depth_sigma = 0.02 * point.inverse_depth;
  tracked_.frame = now;
  EXPECT_EQ(MarkDynamicFeatures({}, map_, tracked_), tracked_.frame);
}

TEST_F(FreeSpaceTest, MarksLinesByTheirMidpoints) {
  auto now = std::make_shared<Frame>(*tracked_.frame);
  for (const double x : {175.0, 295.0}) {
    LineFeature line;
    line.segment = {{x, 60.0}, {x, 180.0}};
    line.depth.emplace();
    // Slanted: the midpoint of the segment in space is another point than that in the image.
    line.depth->start = x < 200.0 ? 0.4 * kBoard : kWall;
    line.depth->end = x < 200.0 ? 1.6 * kBoard : kWall;
    now->lines.push_back(line);
  }
  tracked_.frame = now;
  const auto marked = MarkDynamicFeatures({}, map_, tracked_);
  EXPECT_TRUE(marked->lines[0].dynamic);
  EXPECT_FALSE(marked->lines[1].dynamic);
}

TEST_F(FreeSpaceTest, IsPartOfDynamicObjectRejection) {
  CellConsensusOptions disabled;
  disabled.enabled = false;
  EXPECT_EQ(MarkDynamicFeatures(disabled, map_, tracked_), tracked_.frame);
}

}  // namespace
}  // namespace msc_vo
