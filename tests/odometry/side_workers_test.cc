// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/side_workers.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(SideWorkers, RunsTasksInParallelRepeatedly) {
  SideWorkers workers(1);
  std::thread::id ran_first;
  std::thread::id ran_second;
  for (int i = 0; i < 1000; ++i) {
    // Each task waits for the other one, so they must run at the same time.
    std::promise<int> to_second;
    std::promise<int> to_first;
    int got_by_first = 0;
    int got_by_second = 0;
    const auto first = [&] {
      to_second.set_value(i);
      got_by_first = to_first.get_future().get();
      ran_first = std::this_thread::get_id();
    };
    const auto second = [&] {
      got_by_second = to_second.get_future().get();
      to_first.set_value(i + 1);
      ran_second = std::this_thread::get_id();
    };
    workers.RunAll({first, second});
    ASSERT_EQ(got_by_first, i + 1);
    ASSERT_EQ(got_by_second, i);
  }
  EXPECT_NE(ran_first, ran_second);
  EXPECT_TRUE(ran_first == std::this_thread::get_id() || ran_second == std::this_thread::get_id());
}

TEST(SideWorkers, RunsTasksOnTheCallerWhileTheWorkerIsBusy) {
  SideWorkers workers(1);
  for (int i = 0; i < 100; ++i) {
    // The first task ends only after all others, which the other thread must run.
    std::promise<void> others_done;
    std::atomic<int> num_done{0};
    std::vector<std::function<void()>> tasks;
    tasks.push_back([&] { others_done.get_future().wait(); });
    for (int k = 0; k < 7; ++k) {
      tasks.push_back([&] {
        if (++num_done == 7) others_done.set_value();
      });
    }
    workers.RunAll(tasks);
    ASSERT_EQ(num_done, 7);
  }
}

TEST(SideWorkers, RethrowsTheFirstException) {
  SideWorkers workers(1);
  bool done = false;
  const auto fine = [&done] { done = true; };
  const auto bad = [] { throw std::runtime_error("bad"); };
  const auto worse = [] { throw std::invalid_argument("worse"); };
  EXPECT_THROW(workers.RunAll({fine, bad}), std::runtime_error);
  EXPECT_TRUE(done);  // the other task was completed
  done = false;
  EXPECT_THROW(workers.RunAll({bad, fine}), std::runtime_error);
  EXPECT_TRUE(done);
  EXPECT_THROW(workers.RunAll({worse, bad}), std::invalid_argument);
  // The next call is not affected.
  done = false;
  EXPECT_NO_THROW(workers.RunAll({fine, [] {}}));
  EXPECT_TRUE(done);
}

TEST(SideWorkers, RunsAsManyTasksAtATimeAsThereAreThreads) {
  constexpr int kNumThreads = 5;  // the caller among them
  SideWorkers workers(kNumThreads - 1);
  std::mutex mutex;
  std::condition_variable changed;
  int num_waiting = 0;
  // Each waits for all others.
  const auto task = [&] {
    std::unique_lock<std::mutex> lock(mutex);
    ++num_waiting;
    changed.notify_all();
    changed.wait(lock, [&] { return num_waiting == kNumThreads; });
  };
  workers.RunAll(std::vector<std::function<void()>>(kNumThreads, task));
  EXPECT_EQ(num_waiting, kNumThreads);
}

TEST(SideWorkers, RunsAllTasksOnTheCallerWithoutThreads) {
  SideWorkers workers(0);
  std::vector<std::thread::id> ran_on;
  const auto task = [&] { ran_on.push_back(std::this_thread::get_id()); };
  workers.RunAll({task, task, task});
  EXPECT_EQ(ran_on, std::vector<std::thread::id>(3, std::this_thread::get_id()));
}

TEST(SideWorkers, AreDestroyedWithoutTasks) { SideWorkers workers(3); }

}  // namespace
}  // namespace msc_vo
