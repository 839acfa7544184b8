// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace msc_vo {

/// Lets other threads pause, step and slow down a loop over frames. Thread-safe.
class Pacing {
 public:
  using Clock = std::chrono::steady_clock;

  void Pause();
  void Resume();
  /// Lets one more frame pass while paused.
  void Step();
  /// Times the pace of the time stamps, 0: as fast as possible. Returns false on a speed that is
  /// negative, not finite, or above 100.
  bool SetSpeed(double speed);

  bool is_paused() const;
  double speed() const;

  /// Waits after a frame with the time stamp (seconds) until the next one may be processed. Returns
  /// early if `is_over` returns true, which it asks at least ten times per second.
  void Wait(double timestamp, const std::function<bool()>& is_over);

 private:
  // Time at which the next frame may be processed.
  Clock::time_point NextTurn(double timestamp);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool paused_ = false;
  int num_steps_ = 0;  // frames that may pass while paused
  double speed_ = 0.0;
  // Where the present pace began.
  bool has_anchor_ = false;
  double last_timestamp_ = 0.0;  // seconds
  Clock::time_point turn_;
};

}  // namespace msc_vo
