// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/keyframe_policy.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// Tests a frame at time `timestamp` with `num` points at a depth of two metres, of which the first
// `tracked` are matched. The last keyframe was at 0 s.
bool IsDue(KeyframePolicy* policy, int num, int tracked, double timestamp = 0.5) {
  Frame frame;
  frame.timestamp = timestamp;
  frame.points.resize(num);
  for (PointFeature& point : frame.points) {
    point.inverse_depth = 0.5;
    point.inverse_depth_sigma = 1.425e-3;
  }
  FrameMatches matches;
  for (int i = 0; i < tracked; ++i) matches.points.push_back({i, i, Eigen::Vector3d::Zero(), true});
  return policy->IsDue(frame, matches);
}

TEST(KeyframePolicy, IsDueWhenTheTrackedRatioFalls) {
  KeyframePolicy policy{KeyframePolicyOptions()};
  EXPECT_FALSE(IsDue(&policy, 100, 60));
  EXPECT_FALSE(IsDue(&policy, 100, 60));
  EXPECT_FALSE(IsDue(&policy, 100, 54));
  EXPECT_TRUE(IsDue(&policy, 100, 40));
}

TEST(KeyframePolicy, IsNotDueForFewFeaturesAlone) {
  KeyframePolicy policy{KeyframePolicyOptions()};
  EXPECT_FALSE(IsDue(&policy, 1000, 600));
  EXPECT_FALSE(IsDue(&policy, 25, 15));
  EXPECT_FALSE(IsDue(&policy, 0, 0));
}

TEST(KeyframePolicy, IsDueAfterTheMaximumInterval) {
  KeyframePolicyOptions options;
  options.max_interval = 0.5;
  KeyframePolicy policy(options);
  for (const double timestamp : {0.1, 0.2, 0.4}) {
    EXPECT_FALSE(IsDue(&policy, 100, 60, timestamp));
  }
  EXPECT_TRUE(IsDue(&policy, 100, 60, 0.5));
  policy.Inserted(0.5);
  EXPECT_FALSE(IsDue(&policy, 100, 60, 0.9));
  EXPECT_TRUE(IsDue(&policy, 100, 60, 1.0));
}

TEST(KeyframePolicy, IsNotDueBeforeTheMinimumInterval) {
  KeyframePolicyOptions options;
  options.min_interval = 0.3;
  KeyframePolicy policy(options);
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
  KeyframePolicy policy{KeyframePolicyOptions()};
  EXPECT_FALSE(policy.IsDue(frame, matches(40, 20)));
  EXPECT_FALSE(policy.IsDue(frame, matches(36, 24)));
  EXPECT_TRUE(policy.IsDue(frame, matches(30, 30)));  // close: 0.75 of the best ratio
}

TEST(KeyframePolicy, ChecksItsOptions) {
  std::string error;
  KeyframePolicyOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.max_interval = 0.01;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("max_interval"));
}

}  // namespace
}  // namespace msc_vo
