// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace msc_vo {

/// Threads that process independent tasks together with their caller. Each takes the next task when
/// it has finished one, so that the caller never waits for a thread that has not been scheduled.
/// The threads are reused, because starting them for each frame costs more than they save. For use
/// by one thread at a time.
class SideWorkers {
 public:
  /// `num_threads` >= 0: beside the caller.
  explicit SideWorkers(int num_threads);
  ~SideWorkers() { Stop(); }
  SideWorkers(const SideWorkers&) = delete;
  SideWorkers& operator=(const SideWorkers&) = delete;

  /// Starts the tasks in order, on all threads, and returns when all are
  /// done. If tasks throw, the exception of the first of them in order is rethrown then.
  void RunAll(const std::vector<std::function<void()>>& tasks);

 private:
  bool HasTask() const { return tasks_ != nullptr && next_ < tasks_->size(); }
  void RunNext(std::unique_lock<std::mutex>* lock);
  void Loop();
  void Stop();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::vector<std::function<void()>>* tasks_ = nullptr;
  size_t next_ = 0;         // index of the next task
  size_t num_running_ = 0;  // tasks that have been started and not finished
  size_t first_error_ = 0;  // index of the first task that threw
  std::exception_ptr error_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;  // last: they use the members above
};

}  // namespace msc_vo
