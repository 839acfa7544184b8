// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/pose_support.h"

#include <memory>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

Frame FrameWith(int num_points, int num_lines) {
  Frame frame;
  frame.points.resize(num_points);
  frame.lines.resize(num_lines);
  return frame;
}

TEST(NumMatchable, IsAtMostTheNumberOfFeaturesOfEachKind) {
  const Frame frame = FrameWith(80, 20);
  const MatchCounts other{{40, 10}, 40};
  EXPECT_EQ(NumMatchable(frame, {{50, 15}, 0}, other), 65);
  EXPECT_EQ(NumMatchable(frame, {{50, 200}, 0}, other), 70);
  EXPECT_EQ(NumMatchable(frame, {{800, 200}, 0}, other), 100);
}

TEST(NumMatchable, IsAtMostTheNumberInViewAtTheOtherPlaceIfThatIsMore) {
  const MatchCounts other{{300, 10}, 40};
  EXPECT_EQ(NumMatchable(FrameWith(80, 20), {{200, 15}, 0}, other), 215);
  EXPECT_EQ(NumMatchable(FrameWith(80, 20), {{800, 200}, 0}, other), 320);
}

TEST(HasComparableMatchRatio, RequiresHalfOfTheOtherRatio) {
  const Frame frame = FrameWith(500, 0);
  const MatchCounts other{{100, 0}, 40};
  EXPECT_TRUE(HasComparableMatchRatio(frame, {{200, 0}, 80}, other));
  EXPECT_TRUE(HasComparableMatchRatio(frame, {{200, 0}, 40}, other));
  EXPECT_FALSE(HasComparableMatchRatio(frame, {{200, 0}, 39}, other));
}

// A frame of 1100 features. A place seen often (620 of 3000) is found from a map seen once (620 of
// 900); the edge of a map (60 of 500) from one seen often, but not from one seen once.
TEST(HasComparableMatchRatio, AllowsForHowOftenPlacesWereSeen) {
  const Frame frame = FrameWith(1100, 0);
  const MatchCounts seen_often{{3000, 0}, 620}, seen_once{{900, 0}, 620}, edge{{500, 0}, 60};
  EXPECT_TRUE(HasComparableMatchRatio(frame, seen_often, seen_once));
  EXPECT_TRUE(HasComparableMatchRatio(frame, edge, seen_often));
  EXPECT_FALSE(HasComparableMatchRatio(frame, edge, seen_once));
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
