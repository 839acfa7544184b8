// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/pacing.h"

#include <atomic>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using std::chrono::milliseconds;

bool Never() { return false; }

double MillisecondsOf(const std::function<void()>& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

TEST(Pacing, DoesNotWaitByDefault) {
  Pacing pacing;
  EXPECT_LT(MillisecondsOf([&] {
              for (int i = 0; i < 100; ++i) pacing.Wait(10.0 * i, Never);
            }),
            100.0);
}

TEST(Pacing, FollowsTheTimeStamps) {
  Pacing pacing;
  ASSERT_TRUE(pacing.SetSpeed(2.0));
  const double ms = MillisecondsOf([&] {
    for (int i = 0; i < 5; ++i) pacing.Wait(100.0 + 0.04 * i, Never);
  });
  EXPECT_GE(ms, 79.0);  // four intervals of 20 ms
}

TEST(Pacing, RefusesImpossibleSpeeds) {
  Pacing pacing;
  for (const double speed : {-1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(pacing.SetSpeed(speed)) << speed;
  }
  EXPECT_EQ(pacing.speed(), 0.0);
}

TEST(Pacing, PassesOneFramePerStepWhilePaused) {
  Pacing pacing;
  pacing.Pause();
  std::atomic<int> passed{0};
  std::thread loop([&] {
    for (int i = 0; i < 3; ++i) {
      pacing.Wait(i, Never);
      ++passed;
    }
  });
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_EQ(passed, 0);
  pacing.Step();
  while (passed < 1) std::this_thread::yield();
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_EQ(passed, 1);
  pacing.Resume();
  loop.join();
  EXPECT_EQ(passed, 3);
}

TEST(Pacing, EndsAPauseWhenItIsOver) {
  Pacing pacing;
  pacing.Pause();
  int num_questions = 0;
  pacing.Wait(0.0, [&] { return ++num_questions >= 2; });
  EXPECT_EQ(num_questions, 2);
  // The question may change the pacing.
  pacing.Wait(0.0, [&] {
    pacing.Resume();
    return false;
  });
  EXPECT_FALSE(pacing.is_paused());
}

}  // namespace
}  // namespace msc_vo
