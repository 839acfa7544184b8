// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Decides when a map that cannot be found again is given up for a new segment.
class SegmentStartPolicy {
 public:
  explicit SegmentStartPolicy(const SegmentOptions& options) : options_(options) {}

  /// Reports the first frame of a segment, at `timestamp` (seconds).
  void Started(double timestamp);
  /// Reports a frame that was tracked in the map of the segment.
  void Tracked(double timestamp);
  /// Reports a frame that was not found in the map. If it had enough features to be found
  /// (`is_searched`), the time since the frame before counts as a search, in which `num_keyframes`
  /// keyframes have been tried, some of them not for the first time.
  void NotFound(double timestamp, bool is_searched, int num_keyframes);

  /// Whether the map, which has `num_keyframes`, is given up. A map that is not confirmed is given
  /// up at once: nothing is lost with it. Otherwise the search must last for
  /// SegmentOptions::min_search, and for as many tries as the map has keyframes or until max_search
  /// is reached.
  bool IsDue(int num_keyframes) const;

  /// Time stamp of the last reported frame, seconds.
  double last_timestamp() const { return last_timestamp_; }
  /// Whether a frame after the first one was tracked in the map of the segment.
  bool is_confirmed() const { return is_confirmed_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, confirmed, last_timestamp, search_seconds, num_tried_keyframes] =
        *this;  // all members, or it does not compile
    archive(confirmed, last_timestamp, search_seconds, num_tried_keyframes);
  }

 private:
  SegmentOptions options_;
  bool is_confirmed_ = false;
  double last_timestamp_ = 0.0;
  double search_seconds_ = 0.0;  // since the last tracked frame
  int num_tried_keyframes_ = 0;  // since the last tracked frame
};

}  // namespace msc_vo
