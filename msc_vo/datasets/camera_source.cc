// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_source.h"

#include <utility>

namespace msc_vo {

CameraSource::CameraSource(RgbdCamera* camera, double max_waiting)
    : camera_(camera), max_waiting_(max_waiting) {
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
      MakeRoom(next.image.timestamp);
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

void CameraSource::MakeRoom(double newest) {
  const auto is_recent = [&](const Waiting& waiting) {
    const double age = newest - waiting.image.timestamp;
    return age > 0.0 && age < max_waiting_;  // stamps that do not ascend must not fill the memory
  };
  while (!waiting_.empty() && !is_recent(waiting_.front())) {
    waiting_.pop_front();
    ++num_dropped_;
  }
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
