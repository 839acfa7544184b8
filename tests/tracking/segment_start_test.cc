// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/segment_start.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr int kKeyframesPerFrame = 3;

class SegmentStartTest : public testing::Test {
 protected:
  void SetUp() override {
    policy_.Started(0.0);
    policy_.Tracked(0.1);
  }
  // Reports `count` frames, 0.1 seconds apart, that were not found.
  void Lose(int count, bool is_searched = true) {
    for (int i = 0; i < count; ++i) {
      time_ += 0.1;
      policy_.NotFound(time_, is_searched, kKeyframesPerFrame);
    }
  }

  SegmentStartPolicy policy_{SegmentOptions()};
  double time_ = 0.1;
};

TEST_F(SegmentStartTest, SearchesASmallMapForASecond) {
  Lose(9);
  EXPECT_FALSE(policy_.IsDue(5));
  Lose(2);
  EXPECT_TRUE(policy_.IsDue(5));
}

TEST_F(SegmentStartTest, TriesEveryKeyframeOfAGrownMapOnce) {
  Lose(20);
  EXPECT_FALSE(policy_.IsDue(61));
  Lose(1);
  EXPECT_TRUE(policy_.IsDue(61));
}

TEST_F(SegmentStartTest, SearchesALargeMapForALimitedTime) {
  Lose(49);
  EXPECT_FALSE(policy_.IsDue(10000));
  Lose(2);
  EXPECT_TRUE(policy_.IsDue(10000));
}

TEST_F(SegmentStartTest, DoesNotCountImagesWithoutFeaturesAndGaps) {
  Lose(100, false);
  EXPECT_FALSE(policy_.IsDue(5));
  time_ += 600.0;
  Lose(5);
  EXPECT_FALSE(policy_.IsDue(5));
}

TEST_F(SegmentStartTest, BeginsToSearchAgainAfterATrackedFrame) {
  Lose(9);
  policy_.Tracked(time_);
  Lose(9);
  EXPECT_FALSE(policy_.IsDue(5));
}

TEST_F(SegmentStartTest, GivesUpAMapThatNothingWasTrackedIn) {
  policy_.Started(1.0);
  EXPECT_FALSE(policy_.is_confirmed());
  policy_.NotFound(1.1, true, kKeyframesPerFrame);
  EXPECT_TRUE(policy_.IsDue(1));
}

TEST_F(SegmentStartTest, CanBeDisabled) {
  SegmentOptions options;
  options.enabled = false;
  SegmentStartPolicy policy(options);
  policy.Started(1.0);
  policy.NotFound(1.1, true, kKeyframesPerFrame);
  EXPECT_FALSE(policy.IsDue(1));
}

}  // namespace
}  // namespace msc_vo
