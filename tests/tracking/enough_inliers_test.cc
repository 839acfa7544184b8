// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <gtest/gtest.h>

#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {
namespace {

// A pose from 200 matches of points.
class HasEnoughInliersTest : public ::testing::Test {
 protected:
  HasEnoughInliersTest() {
    pose_.matches.points.resize(200);
    pose_.summary.usable = true;
    pose_.summary.num_inliers.points = 100;
  }
  bool HasEnough() const { return HasEnoughInliers(TrackerOptions(), Frame(), pose_); }

  FramePose pose_;
};

TEST_F(HasEnoughInliersTest, RequiresAUsablePose) {
  EXPECT_TRUE(HasEnough());
  pose_.summary.usable = false;
  EXPECT_FALSE(HasEnough());
}

TEST_F(HasEnoughInliersTest, RequiresARatioOfAllButTheDynamicMatches) {
  pose_.summary.num_inliers.points = 59;
  EXPECT_FALSE(HasEnough());
  pose_.summary.num_dynamic = 10;
  EXPECT_TRUE(HasEnough());
}

TEST_F(HasEnoughInliersTest, RequiresANumberOfMatches) {
  pose_.matches.points.resize(9);
  pose_.summary.num_inliers.points = 9;
  EXPECT_FALSE(HasEnough());
}

// A dynamic object that was not recognised, with most of the matches.
TEST_F(HasEnoughInliersTest, ConfirmedMatchesDecide) {
  pose_.summary.num_confirmed = 50;
  pose_.summary.num_inliers.points = 40;
  pose_.summary.num_confirmed_inliers = 40;
  EXPECT_TRUE(HasEnough());
  pose_.summary.num_inliers.points = 150;
  pose_.summary.num_confirmed_inliers = 10;
  EXPECT_FALSE(HasEnough());
}

TEST_F(HasEnoughInliersTest, AFewConfirmedMatchesDoNotDecide) {
  pose_.summary.num_confirmed = 9;
  EXPECT_TRUE(HasEnough());
  pose_.summary.num_inliers.points = 20;
  pose_.summary.num_confirmed_inliers = 9;
  EXPECT_FALSE(HasEnough());
}

}  // namespace
}  // namespace msc_vo
