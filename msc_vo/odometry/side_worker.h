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

/// A thread that processes independent tasks together with its caller. Each of the two takes the
/// next task when it has finished one, so that the caller never waits for a thread that has not
/// been scheduled. The thread is reused, because starting one per frame costs more than it saves.
/// For use by one thread at a time.
class SideWorker {
 public:
  SideWorker();
  ~SideWorker();
  SideWorker(const SideWorker&) = delete;
  SideWorker& operator=(const SideWorker&) = delete;

  /// Starts the tasks in order, on the calling thread and on the worker, and returns when all are
  /// done. If tasks throw, the exception of the first of them in order is rethrown then.
  void RunAll(const std::vector<std::function<void()>>& tasks);

 private:
  bool HasTask() const { return tasks_ != nullptr && next_ < tasks_->size(); }
  void RunNext(std::unique_lock<std::mutex>* lock);
  void Loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::vector<std::function<void()>>* tasks_ = nullptr;
  size_t next_ = 0;         // index of the next task
  size_t num_running_ = 0;  // tasks that have been started and not finished
  size_t first_error_ = 0;  // index of the first task that threw
  std::exception_ptr error_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses the members above
};

}  // namespace msc_vo
