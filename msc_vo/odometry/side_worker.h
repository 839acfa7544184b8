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

// A thread that helps its caller with tasks that share nothing. Both take the next one whenever
// they are done with one, so that the caller never waits for a helper that got no processor. Made
// once, as making a thread for each frame costs more than it may gain. For one caller at a time.
class SideWorker {
 public:
  SideWorker();
  ~SideWorker();
  SideWorker(const SideWorker&) = delete;
  SideWorker& operator=(const SideWorker&) = delete;

  // Begins the tasks in their order, here and on the worker, and returns when all are done. If some
  // throw, the exception of the first of them is rethrown, as if they ran in turn, after the end of
  // all.
  void RunAll(const std::vector<std::function<void()>>& tasks);

 private:
  bool HasTask() const { return tasks_ != nullptr && next_ < tasks_->size(); }
  void RunNext(std::unique_lock<std::mutex>* lock);
  void Loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::vector<std::function<void()>>* tasks_ = nullptr;
  size_t next_ = 0;         // the first task that nobody has taken
  size_t num_running_ = 0;  // taken and not done
  // Of the tasks that threw, the first, and what.
  size_t first_error_ = 0;
  std::exception_ptr error_;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses the members above
};

}  // namespace msc_vo
