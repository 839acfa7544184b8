// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/side_workers.h"

#include <utility>

namespace msc_vo {

SideWorkers::SideWorkers(int num_threads) {
  try {
    for (int i = 0; i < num_threads; ++i) threads_.emplace_back([this] { Loop(); });
  } catch (...) {  // the system has no more threads
    Stop();
    throw;
  }
}

void SideWorkers::Stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void SideWorkers::RunAll(const std::vector<std::function<void()>>& tasks) {
  std::unique_lock<std::mutex> lock(mutex_);
  tasks_ = &tasks;
  next_ = 0;
  changed_.notify_all();
  while (HasTask()) RunNext(&lock);
  changed_.wait(lock, [this] { return num_running_ == 0; });
  tasks_ = nullptr;
  const std::exception_ptr error = std::exchange(error_, nullptr);
  lock.unlock();
  if (error) std::rethrow_exception(error);
}

// Runs the next task with the lock released.
void SideWorkers::RunNext(std::unique_lock<std::mutex>* lock) {
  const size_t index = next_++;
  const std::function<void()>& task = (*tasks_)[index];
  ++num_running_;
  lock->unlock();
  std::exception_ptr error;
  try {
    task();
  } catch (...) {
    error = std::current_exception();
  }
  lock->lock();
  if (error && (!error_ || index < first_error_)) {
    error_ = error;
    first_error_ = index;
  }
  if (--num_running_ == 0) changed_.notify_all();
}

void SideWorkers::Loop() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stopping_ || HasTask(); });
    if (stopping_) return;
    RunNext(&lock);
  }
}

}  // namespace msc_vo
