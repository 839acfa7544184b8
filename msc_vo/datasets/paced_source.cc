// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/paced_source.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace msc_vo {

PacingClock PacingClock::Steady() {
  using Clock = std::chrono::steady_clock;
  return {[] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); },
          [](double seconds) {
            const std::chrono::duration<double> time(seconds);
            std::this_thread::sleep_until(
                Clock::time_point(std::chrono::duration_cast<Clock::duration>(time)));
          }};
}

namespace {

// Times of the images relative to image `begin`, with pauses cut to kMaxPause.
std::vector<double> RelativeTimes(const std::vector<SequenceEntry>& entries, int begin, int end) {
  std::vector<double> times = {0.0};
  for (int i = begin + 1; i < end; ++i) {
    const double pause = entries[i].timestamp - entries[i - 1].timestamp;
    times.push_back(times.back() + std::min(pause, PacedSource::kMaxPause));
  }
  return times;
}

}  // namespace

PacedSource::PacedSource(const RgbdDecoder& decoder, int begin, int end, PacingClock clock)
    : source_(decoder, begin, end),
      clock_(std::move(clock)),
      begin_(begin),
      next_(begin),
      end_(end),
      times_(RelativeTimes(decoder.index().entries, begin, end)) {}

bool PacedSource::Next(RgbdImage* image, std::vector<int>* dropped) {
  if (next_ == end_) return false;
  if (!start_) {
    const int first = next_++;
    source_.Next(image);
    // Time starts after decoding, which a camera would not need.
    due_ = clock_.now();
    start_ = due_ - Time(first);
    return true;
  }
  const double now = clock_.now();
  int newest = next_;
  while (newest + 1 < end_ && *start_ + Time(newest + 1) <= now) ++newest;
  int oldest = next_;
  while (Time(newest) - Time(oldest) >= kMaxWaiting) dropped->push_back(oldest++);
  next_ = oldest + 1;
  source_.SkipTo(oldest);
  source_.Next(image);
  due_ = *start_ + Time(oldest);
  clock_.sleep_until(due_);
  return true;
}

double PacedSource::Age() const { return clock_.now() - due_; }

}  // namespace msc_vo
