// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/frame.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct KeyframePolicyOptions {
  // A keyframe is due when the share of tracked features has fallen to this part of what it was
  // right after the last keyframe. Relative, because that share depends on how well features repeat
  // in a scene, which no fixed threshold knows. Between 0.75 and 0.85 the errors over all sequences
  // of docs/results.md differ by 2 %, the number of keyframes by a third; with 0.92 and
  // mapping.min_window_interval they are a tenth less, for more time and worse lines of the map far
  // away (docs/experiments.md).
  double min_tracked_ratio = 0.8;
  // The landmarks that the last keyframe created are only there after it; frames between keyframes,
  // at least and at most. 30 frames are one second.
  int min_interval = 2;
  int max_interval = 30;
  // A point is close if its depth is known better than this share of it (0.5 %: 3.5 m for a
  // Kinect). Close points fix the translation, so their share counts on its own too.
  double close_relative_sigma = 0.005;

  bool IsValid(std::string* error) const;
};

// Decides whether a tracked frame becomes a keyframe (paper: Keyframe Insertion): by the ratio of
// the features tracked in the map to these and those that could be created. No fixed number of
// features is asked for: a frame with 15 lines and 10 points is a good frame.
class KeyframePolicy {
 public:
  explicit KeyframePolicy(const KeyframePolicyOptions& options) : options_(options) {}

  // To be asked once for every frame with a pose. Says yes at most once until Inserted().
  bool IsDue(const Frame& frame, const FrameMatches& matches);
  // Tells that the frame asked about last became a keyframe.
  void Inserted();

 private:
  // tracked / (tracked + creatable), of all features and of the close points; 1 if there are none.
  struct Shares {
    double all = 1.0;
    double close = 1.0;
  };
  Shares ComputeShares(const Frame& frame, const FrameMatches& matches) const;

  KeyframePolicyOptions options_;
  int frames_since_keyframe_ = 0;
  Shares best_{0.0, 0.0};  // highest shares since the last keyframe
};

}  // namespace msc_vo
