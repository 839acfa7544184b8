// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/keyframe_policy.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// A frame with `num` points at `depth` metres, of which the first `tracked` are matched.
bool Ask(KeyframePolicy* policy, int num, int tracked, double depth = 2.0) {
  Frame frame;
  frame.points.resize(num);
  for (PointFeature& point : frame.points) {
    point.inverse_depth = 1.0 / depth;
    point.inverse_depth_sigma = 1.425e-3;
  }
  FrameMatches matches;
  for (int i = 0; i < tracked; ++i) matches.points.push_back({i, i, Eigen::Vector3d::Zero(), true});
  return policy->IsDue(frame, matches);
}

TEST(KeyframePolicy, DueWhenTheShareHasFallen) {
  KeyframePolicy policy{KeyframePolicyOptions()};
  EXPECT_FALSE(Ask(&policy, 100, 60));
  EXPECT_FALSE(Ask(&policy, 100, 60));
  EXPECT_FALSE(Ask(&policy, 100, 54));
  EXPECT_TRUE(Ask(&policy, 100, 40));
}

TEST(KeyframePolicy, FewFeaturesAreNoReason) {
  KeyframePolicy policy{KeyframePolicyOptions()};
  EXPECT_FALSE(Ask(&policy, 1000, 600));
  EXPECT_FALSE(Ask(&policy, 25, 15));
  EXPECT_FALSE(Ask(&policy, 0, 0));
}

TEST(KeyframePolicy, DueAfterTheMaximumInterval) {
  KeyframePolicyOptions options;
  options.max_interval = 5;
  KeyframePolicy policy(options);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(Ask(&policy, 100, 60));
  EXPECT_TRUE(Ask(&policy, 100, 60));
  policy.Inserted();
  EXPECT_FALSE(Ask(&policy, 100, 60));
}

TEST(KeyframePolicy, NotBeforeTheMinimumInterval) {
  KeyframePolicyOptions options;
  options.min_interval = 3;
  KeyframePolicy policy(options);
  EXPECT_FALSE(Ask(&policy, 100, 90));
  EXPECT_FALSE(Ask(&policy, 100, 10));
  EXPECT_TRUE(Ask(&policy, 100, 10));
}

TEST(KeyframePolicy, OptionsAreChecked) {
  std::string error;
  KeyframePolicyOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.max_interval = 0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("max_interval"));
}

}  // namespace
}  // namespace msc_vo
