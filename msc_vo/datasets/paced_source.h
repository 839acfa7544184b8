// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "msc_vo/datasets/rgbd_source.h"

namespace msc_vo {

/// The clock of a PacedSource; tests replace it.
struct PacingClock {
  std::function<double()> now;                      ///< seconds
  std::function<void(double seconds)> sleep_until;  ///< returns at once if the time has passed

  /// The steady clock of the machine.
  static PacingClock Steady();
};

/// Delivers the images of a sequence in real time, as a camera would: the first one at once, each
/// other one when the time between their stamps has passed. If the reader is late, images wait in a
/// queue like that of a camera driver; when it spans more than kMaxWaiting, the oldest images are
/// dropped. Pauses between two stamps are cut to kMaxPause.
class PacedSource {
 public:
  /// Length of the queue, seconds: an image is dropped when another one that is so much later
  /// arrives. Three images fit at 30 Hz, six at 60 Hz, one at 10 Hz; the value is between multiples
  /// of usual intervals, so that rounding decides nothing. A reader that needs half the time
  /// between two images catches up within as many images; poses with a longer delay are of little
  /// use.
  static constexpr double kMaxWaiting = 0.09;
  /// Seconds: longer than pauses of a recording, short enough that the program does not seem to
  /// hang.
  static constexpr double kMaxPause = 10.0;

  /// Delivers images begin..end-1 of the decoder, which must outlive the source. Throws like
  /// RgbdSource.
  PacedSource(const RgbdDecoder& decoder, int begin, int end,
              PacingClock clock = PacingClock::Steady());

  /// Returns the oldest image in the queue, or waits for the next image if the queue is empty.
  /// Appends the indices of the images dropped before it to `dropped`. Returns false at the end.
  /// Throws like RgbdSource::Next().
  bool Next(RgbdImage* image, std::vector<int>* dropped);

  /// Seconds since the image that Next() returned last was due.
  double Age() const;

 private:
  double Time(int i) const { return times_[i - begin_]; }

  RgbdSource source_;
  PacingClock clock_;
  int begin_;
  int next_;
  int end_;
  std::vector<double> times_;    // seconds after image begin_, one per image
  std::optional<double> start_;  // clock time of image begin_; none before the first image
  double due_ = 0.0;             // clock time of the last image
};

}  // namespace msc_vo
