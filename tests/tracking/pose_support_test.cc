// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_support.h"

#include <memory>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A frame with 80 points and 20 lines that shows 40 of 100 landmarks of the current map, a quarter
// of them lines.
TrackedFrame FrameInCurrentMap() {
  auto frame = std::make_shared<Frame>();
  frame->points.resize(80);
  frame->lines.resize(20);
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.matches.points.resize(30);
  tracked.matches.lines.resize(10);
  tracked.visible.points.resize(80);
  tracked.visible.lines.resize(20);
  return tracked;
}

// Whether `num_found` landmarks are enough at a place where so many are in view.
bool HasComparableMatchRatioWith(size_t num_found, size_t num_points, size_t num_lines) {
  FrameMatches found;
  found.points.resize(num_found - 5);
  found.lines.resize(5);
  LocalMap place;
  place.points.resize(num_points);
  place.lines.resize(num_lines);
  return HasComparableMatchRatio(found, place, FrameInCurrentMap());
}

TEST(HasComparableMatchRatio, RequiresHalfOfTheRatioInTheCurrentMap) {
  EXPECT_TRUE(HasComparableMatchRatioWith(20, 40, 10));
  EXPECT_TRUE(HasComparableMatchRatioWith(10, 40, 10));
  EXPECT_FALSE(HasComparableMatchRatioWith(9, 40, 10));
}

// A map of many visits, of which the frame can match 100 landmarks.
TEST(HasComparableMatchRatio, CountsNoMoreLandmarksThanFeatures) {
  EXPECT_TRUE(HasComparableMatchRatioWith(20, 800, 200));
  EXPECT_FALSE(HasComparableMatchRatioWith(19, 800, 200));
}

std::shared_ptr<Frame> FrameAtWall(double distance) {
  auto frame = std::make_shared<Frame>();
  const auto w = static_cast<float>(1.0 / distance);
  frame->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {w, w});
  return frame;
}

// The frame looks at a wall at 3 metres, through the wall at 2 metres of its reference keyframe.
TEST(ContradictsDepth, ComparesTheImageWithTheFeatures) {
  Map map;
  TrackedFrame tracked;
  tracked.reference = map.AddKeyframe(FrameAtWall(2.0), Rigid3());
  tracked.frame = FrameAtWall(3.0);
  tracked.pose.num_inliers.points = 20;
  EXPECT_TRUE(ContradictsDepth(tracked, map));
  tracked.pose.num_inliers.points = 800;  // more than there are cells
  EXPECT_FALSE(ContradictsDepth(tracked, map));
}

TEST(ContradictsDepth, BelievesAPoseThatImagesAgreeWith) {
  Map map;
  TrackedFrame tracked;
  tracked.reference = map.AddKeyframe(FrameAtWall(2.0), Rigid3());
  tracked.frame = FrameAtWall(2.0);
  EXPECT_FALSE(ContradictsDepth(tracked, map));
  tracked.reference = kNoId;
  tracked.frame = FrameAtWall(3.0);
  EXPECT_FALSE(ContradictsDepth(tracked, map));
}

PoseSummary PoseWith(int num_inliers, int num_dynamic, int num_confirmed_inliers) {
  PoseSummary pose;
  pose.num_inliers.points = num_inliers;
  pose.num_dynamic = num_dynamic;
  pose.num_confirmed_inliers = num_confirmed_inliers;
  return pose;
}

TEST(IsClearlyBetter, ComparesConfirmedInliers) {
  const TrackerOptions options;
  // Matches by chance, most of which were taken for dynamic, and the right pose after a large step.
  EXPECT_TRUE(IsClearlyBetter(options, PoseWith(188, 0, 63), PoseWith(13, 288, 6)));
  // The right pose beside a dynamic object, and the pose that moves with the object.
  EXPECT_FALSE(IsClearlyBetter(options, PoseWith(300, 0, 5), PoseWith(60, 0, 30)));
  EXPECT_FALSE(IsClearlyBetter(options, PoseWith(60, 0, 40), PoseWith(60, 0, 30)));
}

TEST(IsClearlyBetter, ComparesAllInliersIfFewAreConfirmed) {
  const TrackerOptions options;
  EXPECT_TRUE(IsClearlyBetter(options, PoseWith(100, 0, 5), PoseWith(60, 0, 9)));
  EXPECT_FALSE(IsClearlyBetter(options, PoseWith(100, 0, 9), PoseWith(60, 60, 5)));
}

}  // namespace
}  // namespace msc_vo
