// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {
namespace {

// A pose from 200 matches of points.
class HasEnoughInliersTest : public ::testing::Test {
 protected:
  HasEnoughInliersTest() {
    tracked_.frame = std::make_shared<Frame>();
    tracked_.matches.points.resize(200);
    tracked_.pose.usable = true;
    tracked_.pose.num_inlier_points = 100;
  }
  bool HasEnough() const { return HasEnoughInliers(TrackerOptions(), tracked_); }

  TrackedFrame tracked_;
};

TEST_F(HasEnoughInliersTest, RequiresAUsablePose) {
  EXPECT_TRUE(HasEnough());
  tracked_.pose.usable = false;
  EXPECT_FALSE(HasEnough());
}

TEST_F(HasEnoughInliersTest, RequiresARatioOfAllButTheDynamicMatches) {
  tracked_.pose.num_inlier_points = 59;
  EXPECT_FALSE(HasEnough());
  tracked_.pose.num_dynamic = 10;
  EXPECT_TRUE(HasEnough());
}

TEST_F(HasEnoughInliersTest, RequiresANumberOfMatches) {
  tracked_.matches.points.resize(9);
  tracked_.pose.num_inlier_points = 9;
  EXPECT_FALSE(HasEnough());
}

// A dynamic object that was not recognised, with most of the matches.
TEST_F(HasEnoughInliersTest, ConfirmedMatchesDecide) {
  tracked_.pose.num_confirmed = 50;
  tracked_.pose.num_inlier_points = 40;
  tracked_.pose.num_confirmed_inliers = 40;
  EXPECT_TRUE(HasEnough());
  tracked_.pose.num_inlier_points = 150;
  tracked_.pose.num_confirmed_inliers = 10;
  EXPECT_FALSE(HasEnough());
}

TEST_F(HasEnoughInliersTest, AFewConfirmedMatchesDoNotDecide) {
  tracked_.pose.num_confirmed = 9;
  EXPECT_TRUE(HasEnough());
  tracked_.pose.num_inlier_points = 20;
  tracked_.pose.num_confirmed_inliers = 9;
  EXPECT_FALSE(HasEnough());
}

}  // namespace
}  // namespace msc_vo
