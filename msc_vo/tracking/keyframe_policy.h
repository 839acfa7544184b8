// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/frame.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct KeyframePolicyOptions {
  /// A keyframe is due when the ratio of tracked features falls below this fraction of its best
  /// value since the last keyframe. Relative, because the ratio depends on how well features repeat
  /// in the scene. Chosen by measurement, see docs/lab/tracking.md.
  double min_tracked_ratio = 0.8;
  /// Seconds between keyframes, at least and at most: two and thirty frames at 30 Hz, and no
  /// multiples of usual intervals, so that rounding decides nothing.
  double min_interval = 0.045;
  double max_interval = 0.99;
};

/// Decides whether a tracked frame becomes a keyframe (paper: Keyframe Insertion), by the ratio of
/// the features that are tracked in the map to all features that are or could become landmarks.
/// There is no fixed number of features: a frame with 15 lines and 10 points is a good frame.
class KeyframePolicy {
 public:
  explicit KeyframePolicy(const KeyframePolicyOptions& options) : options_(options) {}

  /// Call once for every frame with a pose. One that is not `certain` is not due because of
  /// max_interval alone.
  bool IsDue(const Frame& frame, const FrameMatches& matches, bool certain);
  /// Reports that the frame with time stamp `timestamp` became a keyframe.
  void Inserted(double timestamp);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, last_frame_time, seconds_since_keyframe, best] =
        *this;  // all members, or it does not compile
    archive(last_frame_time, seconds_since_keyframe, best);
  }

 private:
  // tracked / (tracked + creatable) of all features and of the close points; 1 if there are none.
  struct TrackedRatios {
    double all = 1.0;
    double close = 1.0;
  };
  TrackedRatios ComputeRatios(const Frame& frame, const FrameMatches& matches) const;

  KeyframePolicyOptions options_;
  double last_frame_time_ = 0.0;         // of the last frame with a pose
  double seconds_since_keyframe_ = 0.0;  // gaps count no longer than kMaxFrameInterval
  TrackedRatios best_{0.0, 0.0};         // highest ratios since the last keyframe
};

}  // namespace msc_vo
