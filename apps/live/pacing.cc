// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/pacing.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

constexpr std::chrono::milliseconds kCheckInterval(100);
// Longer pauses between images are cut, seconds.
constexpr double kMaxInterval = 1.0;
constexpr double kMaxSpeed = 100.0;

}  // namespace

void Pacing::Pause() {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = true;
  num_steps_ = 0;
}

void Pacing::Resume() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    paused_ = false;
    has_anchor_ = false;
  }
  changed_.notify_all();
}

void Pacing::Step() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (paused_) ++num_steps_;
  }
  changed_.notify_all();
}

bool Pacing::SetSpeed(double speed) {
  if (!std::isfinite(speed) || speed < 0.0 || speed > kMaxSpeed) return false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    speed_ = speed;
    has_anchor_ = false;
  }
  changed_.notify_all();
  return true;
}

bool Pacing::is_paused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return paused_;
}

double Pacing::speed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return speed_;
}

Pacing::Clock::time_point Pacing::NextTurn(double timestamp) {
  if (speed_ == 0.0) return Clock::now();
  const Clock::time_point now = Clock::now();
  if (!has_anchor_) {
    has_anchor_ = true;
    turn_ = now;
  } else {
    // Each frame lasts as long as the interval before it.
    const double interval = std::clamp(timestamp - last_timestamp_, 0.0, kMaxInterval) / speed_;
    turn_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(interval));
    turn_ = std::max(turn_, now);  // a loop that is late does not catch up in a burst
  }
  last_timestamp_ = timestamp;
  return turn_;
}

void Pacing::Wait(double timestamp, const std::function<bool()>& is_over) {
  std::unique_lock<std::mutex> lock(mutex_);
  Clock::time_point turn = NextTurn(timestamp);
  double speed = speed_;
  while (true) {
    if (paused_ && num_steps_ > 0) {
      --num_steps_;
      return;
    }
    if (speed != speed_) {
      speed = speed_;
      turn = NextTurn(timestamp);
    }
    const Clock::time_point now = Clock::now();
    if (!paused_ && now >= turn) return;
    const Clock::time_point check = now + kCheckInterval;
    changed_.wait_until(lock, paused_ ? check : std::min(turn, check));
    lock.unlock();  // the caller may ask or change this object
    if (is_over()) return;
    lock.lock();
  }
}

}  // namespace msc_vo
