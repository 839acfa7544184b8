// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/motion_plausibility.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A camera that turns at 0.5 radians/second and moves at 0.6 metres/second.
MotionPlausibility SlowCamera() {
  MotionPlausibility plausibility;
  plausibility.Observe(1.0, {{0.0, 0.5, 0.0}, {0.6, 0.0, 0.0}}, false);
  return plausibility;
}

TEST(MotionPlausibility, BelievesAFastMotionThatIsSeen) {
  MotionPlausibility plausibility = SlowCamera();
  plausibility.Observe(1.1, {{0.0, 6.0, 0.0}, {5.0, 0.0, 0.0}}, false);
  EXPECT_FALSE(plausibility.IsQuestioned(1.1));
  // From now on it is plausible in a gap, too.
  plausibility.Observe(2.0, {{0.0, 6.0, 0.0}, {5.0, 0.0, 0.0}}, true);
  EXPECT_FALSE(plausibility.IsQuestioned(2.0));
}

TEST(MotionPlausibility, QuestionsAJumpInAGapForSomeSeconds) {
  for (const bool turns : {true, false}) {
    MotionPlausibility plausibility = SlowCamera();
    const CameraVelocity jump =
        turns ? CameraVelocity{{0.0, 2.0, 0.0}, {}} : CameraVelocity{{}, {0.0, 0.0, 2.0}};
    plausibility.Observe(2.0, jump, true);
    EXPECT_TRUE(plausibility.IsQuestioned(2.0));
    plausibility.Observe(2.1, {{0.0, 0.5, 0.0}, {}}, false);
    EXPECT_TRUE(plausibility.IsQuestioned(6.9));
    EXPECT_FALSE(plausibility.IsQuestioned(7.1));
  }
}

TEST(MotionPlausibility, QuestionsPosesForOtherReasons) {
  MotionPlausibility plausibility = SlowCamera();
  plausibility.Question(2.0);
  EXPECT_TRUE(plausibility.IsQuestioned(2.0));
  EXPECT_TRUE(plausibility.IsQuestioned(6.9));
  EXPECT_FALSE(plausibility.IsQuestioned(7.1));
}

TEST(MotionPlausibility, BelievesSlowMotionsAfterRest) {
  MotionPlausibility plausibility;  // at rest so far
  plausibility.Observe(2.0, {{0.0, 0.8, 0.0}, {0.4, 0.0, 0.0}}, true);
  EXPECT_FALSE(plausibility.IsQuestioned(2.0));
}

}  // namespace
}  // namespace msc_vo
