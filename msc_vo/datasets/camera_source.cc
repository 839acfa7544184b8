// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_source.h"

#include <utility>

namespace msc_vo {

CameraSource::CameraSource(RgbdCamera* camera, int max_waiting)
    : camera_(camera), max_waiting_(static_cast<size_t>(max_waiting)) {
  thread_ = std::thread([this] { TakeImages(); });
}

CameraSource::~CameraSource() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void CameraSource::TakeImages() {
  std::exception_ptr error;
  try {
    for (Waiting next; camera_->Grab(&next.image); next = {}) {
      next.since_arrival.Restart();
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stopping_) break;
      if (waiting_.size() == max_waiting_) {
        waiting_.pop_front();
        ++num_dropped_;
      }
      waiting_.push_back(std::move(next));
      changed_.notify_one();
    }
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  error_ = error;
  ended_ = true;
  changed_.notify_one();
}

bool CameraSource::Next(CameraImage* image, int* num_dropped) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
  *num_dropped += std::exchange(num_dropped_, 0);
  if (waiting_.empty()) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return false;
  }
  *image = std::move(waiting_.front().image);
  waited_ = waiting_.front().since_arrival.Milliseconds();
  age_.Restart();
  waiting_.pop_front();
  return true;
}

}  // namespace msc_vo
