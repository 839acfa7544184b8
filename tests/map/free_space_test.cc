// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/free_space.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A camera that looks at a wall.
Frame FrameAtWall(double distance) {
  Frame frame;
  const auto w = static_cast<float>(1.0 / distance);
  frame.depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {w, w});
  return frame;
}

Frame FrameWithCamera(double distance) {
  Frame frame = FrameAtWall(distance);
  frame.camera = {100.0, 100.0, 100.0, 75.0, 200, 150};
  return frame;
}

TEST(FreeSpace, IsBeforeTheNearestSurface) {
  const Frame frame = FrameWithCamera(2.0);
  EXPECT_TRUE(IsInFreeSpace(frame, {0.1, 0.2, 1.0}));
  EXPECT_FALSE(ShowsSurface(frame, {0.1, 0.2, 1.0}));
  EXPECT_FALSE(IsInFreeSpace(frame, {0.1, 0.2, 1.95}));
  EXPECT_TRUE(ShowsSurface(frame, {0.1, 0.2, 1.95}));
  EXPECT_TRUE(ShowsSurface(frame, {0.1, 0.2, 2.05}));
  EXPECT_FALSE(IsInFreeSpace(frame, {0.1, 0.2, 3.0}));  // hidden
  EXPECT_FALSE(ShowsSurface(frame, {0.1, 0.2, 3.0}));
}

TEST(FreeSpace, IsUnknownOutsideOfTheImage) {
  const Frame frame = FrameWithCamera(2.0);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(3.0, 0.0, 1.0), Eigen::Vector3d(0.0, 0.0, -1.0)}) {
    EXPECT_FALSE(IsInFreeSpace(frame, point));
    EXPECT_FALSE(ShowsSurface(frame, point));
  }
  EXPECT_FALSE(IsInFreeSpace(Frame(), {0.0, 0.0, 1.0}));
}

Rigid3 Forward(double metres) { return {Eigen::Quaterniond::Identity(), {0.0, 0.0, -metres}}; }

TEST(CompareSurfaces, CountsTheCellsOfTheFirstFrame) {
  const Frame far = FrameAtWall(3.0), near = FrameAtWall(2.0);
  const SurfaceAgreement same = CompareSurfaces(far, near, Forward(1.0));
  EXPECT_GT(same.num_same, 200);
  EXPECT_EQ(same.num_violations, 0);
  // The wall at 3 m would be at 1.5 m, in the free space of the second camera, and the wall of that
  // one at 3.5 m, hidden from the first camera.
  const SurfaceAgreement nearer = CompareSurfaces(far, near, Forward(1.5));
  EXPECT_EQ(nearer.num_same, 0);
  EXPECT_GT(nearer.num_violations, 100);
  const SurfaceAgreement hidden = CompareSurfaces(near, far, Forward(1.5).Inverse());
  EXPECT_EQ(hidden.num_same + hidden.num_violations, 0);
}

TEST(CompareSurfaces, ComparesNothingWithoutDepth) {
  const SurfaceAgreement agreement = CompareSurfaces(FrameAtWall(3.0), Frame(), Forward(1.5));
  EXPECT_EQ(agreement.num_same + agreement.num_violations, 0);
}

TEST(NumFreeSpaceViolations, IsZeroAtTheRightPose) {
  EXPECT_EQ(NumFreeSpaceViolations(FrameAtWall(3.0), FrameAtWall(2.0), Forward(1.0)), 0);
}

TEST(NumFreeSpaceViolations, ToleratesSmallErrors) {
  EXPECT_EQ(NumFreeSpaceViolations(FrameAtWall(3.0), FrameAtWall(2.0), Forward(1.08)), 0);
  EXPECT_EQ(NumFreeSpaceViolations(FrameAtWall(3.0), FrameAtWall(2.0), Forward(0.92)), 0);
}

TEST(NumFreeSpaceViolations, CountsSurfacesThatAreLookedThrough) {
  // 1.5 metres nearer, the second camera should be at 1.5 metres of the wall, and looks through it
  // up to 2 metres; or it should be at 2.5 metres, and the first one looks through its wall.
  EXPECT_GT(NumFreeSpaceViolations(FrameAtWall(3.0), FrameAtWall(2.0), Forward(1.5)), 100);
  EXPECT_GT(NumFreeSpaceViolations(FrameAtWall(3.0), FrameAtWall(2.0), Forward(0.5)), 100);
}

// Something near hides the wall from the second camera; the first one sees past it.
TEST(NumFreeSpaceViolations, DoesNotCountWhatIsHidden) {
  Frame before = FrameAtWall(3.0), behind = FrameAtWall(3.0);
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < 8; ++column) {
      behind.depth_ranges.cells[row * DepthRanges::kColumns + column] = {1.0f, 1.0f};
    }
  }
  // The camera has moved by 2 metres to the right: what is at 1 metre was outside of the image.
  const Rigid3 to_the_right(Eigen::Quaterniond::Identity(), {-2.0, 0.0, 0.0});
  EXPECT_EQ(NumFreeSpaceViolations(before, behind, to_the_right), 0);
}

TEST(NumFreeSpaceViolations, DoesNotCountCellsWithoutDepth) {
  Frame blind = FrameAtWall(2.0);
  for (DepthRanges::Cell& cell : blind.depth_ranges.cells) cell = {};
  EXPECT_EQ(NumFreeSpaceViolations(FrameAtWall(3.0), blind, Forward(1.5)), 0);
  EXPECT_EQ(NumFreeSpaceViolations(blind, FrameAtWall(3.0), Forward(1.5)), 0);
  EXPECT_EQ(NumFreeSpaceViolations(FrameAtWall(3.0), Frame(), Forward(1.5)), 0);
}

// A cell that shows a near and a far surface is looked through only beyond the far one, and looks
// through what is before the near one.
TEST(NumFreeSpaceViolations, TakesTheFarSurfaceOfACell) {
  Frame mixed = FrameAtWall(3.0);
  for (DepthRanges::Cell& cell : mixed.depth_ranges.cells) cell.max_inverse_depth = 1.0f;
  EXPECT_EQ(NumFreeSpaceViolations(mixed, FrameAtWall(3.0), Rigid3()), 0);
  EXPECT_EQ(NumFreeSpaceViolations(mixed, FrameAtWall(2.0), Rigid3()), 0);
}

}  // namespace
}  // namespace msc_vo
