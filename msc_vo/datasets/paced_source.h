// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "msc_vo/datasets/rgbd_source.h"

namespace msc_vo {

// A clock to keep pace with. The default is the steady clock of the machine.
struct PacingClock {
  std::function<double()> now;                      // seconds
  std::function<void(double seconds)> sleep_until;  // returns at once if the time has passed

  static PacingClock Steady();
};

// The images of a sequence as a camera would deliver them: the first at once, each other one when
// as much time has passed as between their time stamps. Images wait for a reader who is late, as
// they do in the driver of a camera; where one more would have to wait, the oldest is dropped.
// Longer pauses than kMaxPause between two stamps are cut to that.
class PacedSource {
 public:
  // Images that wait. A tenth of a second at 30 Hz: who tracks in half the time between two images
  // has made up for it after as many more, and a pose that is later is of little use.
  static constexpr int kMaxWaiting = 3;
  // Seconds. Far more than a recording pauses, less than a user waits before he thinks that the
  // program hangs.
  static constexpr double kMaxPause = 10.0;

  // Images begin..end-1 of the decoder, which must outlive the source. Throws as RgbdSource does.
  PacedSource(const RgbdDecoder& decoder, int begin, int end,
              PacingClock clock = PacingClock::Steady());

  // Waits for the next image, or takes the oldest that waits. The indices of the dropped ones
  // before it are appended to `dropped`. False at the end. Throws as RgbdSource does.
  bool Next(RgbdImage* image, std::vector<int>* dropped);

  // Seconds since the last image appeared.
  double Age() const;

 private:
  double Time(int i) const { return times_[i - begin_]; }

  RgbdSource source_;
  PacingClock clock_;
  int begin_;
  int next_;
  int end_;
  std::vector<double> times_;    // seconds from image begin_, one for each image
  std::optional<double> start_;  // where time 0 is on the clock; none before the first image
  double appeared_ = 0.0;        // on the clock, the last image
};

}  // namespace msc_vo
