// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/keyframe_policy.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A policy whose last keyframe was at `timestamp`.
KeyframePolicy PolicyAfterKeyframe(const KeyframePolicyOptions& options, double timestamp = 0.0) {
  KeyframePolicy policy(options);
  policy.Inserted(timestamp);
  return policy;
}

// Tests a frame at time `timestamp` with `num` points at a depth of two metres, of which the first
// `tracked` are matched.
bool IsDue(KeyframePolicy* policy, int num, int tracked, double timestamp = 0.5,
           bool certain = true) {
  Frame frame;
  frame.timestamp = timestamp;
  frame.points.resize(num);
  for (PointFeature& point : frame.points) {
    point.inverse_depth = 0.5;
    point.inverse_depth_sigma = 1.425e-3;
  }
  FrameMatches matches;
  for (int i = 0; i < tracked; ++i) matches.points.push_back({i, i, Eigen::Vector3d::Zero(), true});
  return policy->IsDue(frame, matches, certain);
}

TEST(KeyframePolicy, IsDueWhenTheTrackedRatioFalls) {
  KeyframePolicy policy = PolicyAfterKeyframe({});
  EXPECT_FALSE(IsDue(&policy, 100, 60));
  EXPECT_FALSE(IsDue(&policy, 100, 60));
  EXPECT_FALSE(IsDue(&policy, 100, 54));
  EXPECT_TRUE(IsDue(&policy, 100, 40));
}

TEST(KeyframePolicy, IsNotDueForFewFeaturesAlone) {
  KeyframePolicy policy = PolicyAfterKeyframe({});
  EXPECT_FALSE(IsDue(&policy, 1000, 600));
  EXPECT_FALSE(IsDue(&policy, 25, 15));
  EXPECT_FALSE(IsDue(&policy, 0, 0));
}

// Its features are followed from frame to frame, and the last keyframe shows none of them.
TEST(KeyframePolicy, IsDueWhereNothingIsInTheMap) {
  KeyframePolicy policy = PolicyAfterKeyframe({});
  EXPECT_FALSE(IsDue(&policy, 100, 0, 0.03, false));
  EXPECT_TRUE(IsDue(&policy, 100, 0, 0.06, false));
  EXPECT_FALSE(IsDue(&policy, 100, 1, 0.09, false));
  EXPECT_FALSE(IsDue(&policy, 0, 0, 0.12, false));
}

// The number of the first frame after a keyframe at `start` that is due, at `fps` frames per
// second.
int FirstDue(double start, double fps, int tracked) {
  KeyframePolicy policy = PolicyAfterKeyframe({}, start);
  // The best ratio is that of the first frame.
  for (int k = 1; k < 1000; ++k) {
    if (IsDue(&policy, 100, k == 1 ? 90 : tracked, start + k / fps)) return k;
  }
  return -1;
}

TEST(KeyframePolicy, KeepsItsIntervalsAtEveryRateAndOriginOfTime) {
  for (const double start : {-1000.0, 0.0, 1.0, 1305031102.175304}) {
    EXPECT_EQ(FirstDue(start, 30.0, 90), 30) << start;
    EXPECT_EQ(FirstDue(start, 60.0, 90), 60) << start;
    EXPECT_EQ(FirstDue(start, 25.0, 90), 25) << start;
    EXPECT_EQ(FirstDue(start, 5.0, 90), 5) << start;
    EXPECT_EQ(FirstDue(start, 30.0, 10), 2) << start;
    EXPECT_EQ(FirstDue(start, 60.0, 10), 3) << start;
    EXPECT_EQ(FirstDue(start, 20.0, 10), 2) << start;
  }
}

TEST(KeyframePolicy, BeginsTheIntervalWithTheKeyframe) {
  KeyframePolicyOptions options;
  options.max_interval = 0.45;
  KeyframePolicy policy = PolicyAfterKeyframe(options);
  for (const double timestamp : {0.1, 0.2, 0.4}) {
    EXPECT_FALSE(IsDue(&policy, 100, 60, timestamp));
  }
  EXPECT_TRUE(IsDue(&policy, 100, 60, 0.5));
  policy.Inserted(0.5);
  EXPECT_FALSE(IsDue(&policy, 100, 60, 0.9));
  EXPECT_TRUE(IsDue(&policy, 100, 60, 1.0));
}

TEST(KeyframePolicy, WaitsForACertainPoseAfterTheMaximumInterval) {
  KeyframePolicy policy = PolicyAfterKeyframe({});
  for (const double timestamp : {0.4, 0.8}) EXPECT_FALSE(IsDue(&policy, 100, 60, timestamp));
  Frame frame;
  frame.timestamp = 1.1;
  EXPECT_FALSE(policy.IsDue(frame, {}, false));
  frame.timestamp = 1.2;
  EXPECT_TRUE(policy.IsDue(frame, {}, true));
}

TEST(KeyframePolicy, IsNotDueBecauseOfAGap) {
  KeyframePolicy policy = PolicyAfterKeyframe({});
  EXPECT_FALSE(IsDue(&policy, 100, 60, 0.1));
  EXPECT_FALSE(IsDue(&policy, 100, 60, 20.0));  // counts half a second
  EXPECT_FALSE(IsDue(&policy, 100, 60, 20.3));
  EXPECT_TRUE(IsDue(&policy, 100, 60, 20.5));
}

TEST(KeyframePolicy, IsNotDueBeforeTheMinimumInterval) {
  KeyframePolicyOptions options;
  options.min_interval = 0.25;
  KeyframePolicy policy = PolicyAfterKeyframe(options);
  EXPECT_FALSE(IsDue(&policy, 100, 90, 0.1));
  EXPECT_FALSE(IsDue(&policy, 100, 10, 0.2));
  EXPECT_TRUE(IsDue(&policy, 100, 10, 0.3));
}

// Of 40 close and 60 distant points, 60 are tracked in every frame, but fewer and fewer close ones.
TEST(KeyframePolicy, TestsCloseFeaturesSeparately) {
  Frame frame;
  frame.timestamp = 0.5;
  frame.points.resize(100);
  for (int i = 0; i < 100; ++i) {
    frame.points[i].inverse_depth = i < 40 ? 1.0 : 0.1;
    frame.points[i].inverse_depth_sigma = 1.425e-3;
  }
  const auto matches = [](int close, int distant) {
    FrameMatches tracked;
    for (int i = 0; i < close; ++i) tracked.points.push_back({i, i, {0, 0, 0}, true});
    for (int i = 40; i < 40 + distant; ++i) tracked.points.push_back({i, i, {0, 0, 0}, true});
    return tracked;
  };
  KeyframePolicy policy = PolicyAfterKeyframe({});
  EXPECT_FALSE(policy.IsDue(frame, matches(40, 20), true));
  EXPECT_FALSE(policy.IsDue(frame, matches(36, 24), true));
  EXPECT_TRUE(policy.IsDue(frame, matches(30, 30), true));  // close: 0.75 of the best ratio
}

}  // namespace
}  // namespace msc_vo
