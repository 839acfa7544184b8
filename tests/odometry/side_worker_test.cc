// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/side_worker.h"

#include <future>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(SideWorker, RunsBothTasksSideBySideAgainAndAgain) {
  SideWorker worker;
  const std::thread::id caller = std::this_thread::get_id();
  std::thread::id side;
  for (int i = 0; i < 1000; ++i) {
    // Each waits for the other: this only ends if they run at the same time.
    std::promise<int> to_second;
    std::promise<int> to_first;
    int got_by_first = 0;
    int got_by_second = 0;
    worker.RunPair(
        [&] {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          to_second.set_value(i);
          got_by_first = to_first.get_future().get();
        },
        [&] {
          if (i > 0) {
            EXPECT_EQ(std::this_thread::get_id(), side);
          }
          side = std::this_thread::get_id();
          got_by_second = to_second.get_future().get();
          to_first.set_value(i + 1);
        });
    ASSERT_EQ(got_by_first, i + 1);
    ASSERT_EQ(got_by_second, i);
  }
  EXPECT_NE(side, caller);
}

TEST(SideWorker, CarriesExceptionsOver) {
  SideWorker worker;
  bool done = false;
  const auto fine = [&done] { done = true; };
  const auto bad = [] { throw std::runtime_error("bad"); };
  const auto worse = [] { throw std::invalid_argument("worse"); };
  EXPECT_THROW(worker.RunPair(fine, bad), std::runtime_error);
  EXPECT_TRUE(done);  // the other task ran to its end
  done = false;
  EXPECT_THROW(worker.RunPair(bad, fine), std::runtime_error);
  EXPECT_TRUE(done);
  EXPECT_THROW(worker.RunPair(worse, bad), std::invalid_argument);
  // Nothing of it is left.
  done = false;
  EXPECT_NO_THROW(worker.RunPair(fine, [] {}));
  EXPECT_TRUE(done);
}

TEST(SideWorker, EndsWithoutWork) { SideWorker worker; }

}  // namespace
}  // namespace msc_vo
