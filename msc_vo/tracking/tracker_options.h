// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/matching/landmark_matchers.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/pose_estimation/relocalizer.h"
#include "msc_vo/tracking/keyframe_policy.h"

namespace msc_vo {

/// When a run gives up a map that it cannot find again and begins a new segment, and how it
/// searches the maps of older segments meanwhile. See docs/lab/segments.md.
struct SegmentOptions {
  /// Begin new segments. Otherwise a run without its map stays lost until it finds it.
  bool enabled = true;
  /// Time for which the map is searched in images with enough features, seconds: longer than blur
  /// or a hand in front of the lens usually last. The search goes on for as many
  /// tries as the map has keyframes, but not longer than the maximum.
  double min_search = 1.0;
  double max_search = 5.0;
  /// Shortest time between two frames that are found in an inactive map, seconds. With 0.06, these
  /// are every image at 15 Hz and every second one at 30 Hz, and the three that a join needs take
  /// at most 0.13 s.
  double search_interval = 0.06;
};

struct TrackerOptions {
  MatcherOptions matchers;
  PoseOptions pose;
  KeyframePolicyOptions keyframes;
  RelocalizerOptions relocalizer;
  SegmentOptions segments;

  /// Search radii, pixels. The error of the constant-velocity prediction of a hand-held camera at
  /// 30 Hz is up to about 15 pixels; the wide search allows four times that. Around an estimated
  /// pose the error of the landmarks remains: a few sigmas.
  double prediction_radius = 15.0;
  double wide_radius = 60.0;
  double local_map_radius = 4.0;

  /// Largest number of keyframes whose landmarks form the local map.
  int max_local_keyframes = 30;

  /// Smallest number of inlier matches of a pose, points and lines together (NumMatches). Six rows
  /// determine a pose; ten matches exclude a consensus of random ones.
  int min_matches = 10;
  /// Smallest ratio of inliers among the matches of a pose, see HasEnoughInliers().
  double min_inlier_ratio = 0.3;
  /// Standard deviations of a pose above which the status is kWeak.
  double weak_translation_sigma = 0.02;  ///< metres
  double weak_rotation_sigma = 1.0;      ///< degrees
  /// Longest gap that is bridged by constant velocity.
  double max_prediction = 0.5;  ///< seconds
  /// Keyframes that relocalisation tries in 1/30 s, at least one per frame (KeyframesToTry): the
  /// one that looks most like the frame, and others in turn (TryOrder).
  int relocalization_keyframes = 3;
  /// Whether keyframes are searched for parts of their map that they share no landmarks with.
  bool find_loops = true;
  /// Features with depth that the first frame needs, points and lines together (CanBeginMap).
  int min_initial_features = 20;
};

}  // namespace msc_vo
