// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/pose_estimation/relocalizer.h"
#include "msc_vo/tracking/keyframe_policy.h"

namespace msc_vo {

struct TrackerOptions {
  PointMatcherOptions point_matcher;
  LineMatcherOptions line_matcher;
  PoseOptions pose;
  KeyframePolicyOptions keyframes;
  RelocalizerOptions relocalizer;

  // Search radii, pixels. Around the constant-velocity prediction at 30 Hz a hand shakes by up to
  // about 15 pixels; the wide search allows four times that. Around an estimated pose what remains
  // is the error of the landmarks: a few sigmas.
  double prediction_radius = 15.0;
  double wide_radius = 60.0;
  double local_map_radius = 4.0;

  int max_local_keyframes = 30;

  // A pose stands on at least this many matched features, points and lines together: with 10, a
  // wrong consensus among random matches is out of the question (six are needed to fix a pose).
  int min_matches = 10;
  // ... and on at least this share of all that were matched, but for what moves by itself; the
  // wrong ones scatter.
  double min_inlier_ratio = 0.3;
  // Standard deviations of a pose above which a frame counts as weak: what one frame may add to
  // the error of a trajectory that is to be good to a few centimetres and a degree.
  double weak_translation_sigma = 0.02;  // metres
  double weak_rotation_sigma = 1.0;      // degrees
  // A gap is bridged by constant velocity for this long; a hand does not keep it up longer.
  double max_prediction = 0.5;  // seconds
  // Keyframes tried per frame while the map is searched, newest and least recently tried first.
  int relocalization_keyframes = 3;
  // A first frame needs this many features with depth, points and lines together.
  int min_initial_features = 20;

  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
