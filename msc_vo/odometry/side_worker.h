// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace msc_vo {

// A thread that waits for work and does it beside the caller's own: two tasks that share nothing
// take the time of the longer one. Made once, as making a thread for each frame costs more than it
// may gain. For one caller at a time.
class SideWorker {
 public:
  SideWorker();
  ~SideWorker();
  SideWorker(const SideWorker&) = delete;
  SideWorker& operator=(const SideWorker&) = delete;

  // Runs `first` here and `second` on the worker, and returns when both are done. If both throw,
  // the exception of `first` is rethrown, as it would be if they ran in turn.
  void RunPair(const std::function<void()>& first, const std::function<void()>& second);

 private:
  void Loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* task_ = nullptr;  // waiting or running
  std::exception_ptr error_;                     // of the last task
  bool stopping_ = false;
  std::thread thread_;  // last: it uses the members above
};

}  // namespace msc_vo
