// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

struct SyntheticWindowOptions {
  SceneKind scene = SceneKind::kRoom;
  uint64_t seed = 1;  // of the scene, the path, the landmarks and the noise
  PinholeCamera camera;

  int num_keyframes = 8;
  double keyframe_interval = 0.4;  // seconds along a walk of 0.35 m/s
  int num_fixed = 1;               // the first keyframes are held at the truth: the gauge
  // Landmarks asked for; fewer if the keyframes do not see so many. Each is seen at least twice.
  int num_points = 300;
  int num_lines = 60;

  // Sigmas that stand in the observations, and the noise that goes with them if `noise` is true.
  bool noise = true;
  double point_sigma = 1.0;               // pixels, of each coordinate
  double line_sigma = 1.0;                // pixels, of an end point's distance to the true line
  double inverse_depth_sigma = 1.425e-3;  // 1/metres, of one depth sample; a Kinect's
  bool depth = true;                      // points and lines have depth
  double outlier_ratio = 0.0;             // share of observations that are far off

  // Start: normal deviates from the truth, of what is not fixed.
  double start_rotation_sigma = 0.01;     // radians, per axis
  double start_translation_sigma = 0.02;  // metres, per axis
  double start_point_sigma = 0.03;        // metres, per axis
  double start_line_sigma = 0.03;         // metres, per axis and end point

  bool IsValid(std::string* error) const;
};

struct SyntheticWindow {
  WindowData truth;                  // true states, exact observations
  WindowData data;                   // where a solver starts: disturbed states, noisy observations
  std::vector<bool> point_outliers;  // per point observation of `data`
  std::vector<bool> line_outliers;   // per line observation of `data`
};

// A sliding window at feature level: keyframes along the path through a scene; points where random
// pixels hit its surfaces; lines along its edges, each landmark the part that its first keyframe
// sees, observed in others as far as it is inside the image and not occluded. Line depths carry the
// covariance of a regression on evenly spaced samples, and noise with that covariance.
// The same options give the same window. Throws std::invalid_argument on options that are not
// valid.
SyntheticWindow MakeSyntheticWindow(const SyntheticWindowOptions& options);

}  // namespace msc_vo
