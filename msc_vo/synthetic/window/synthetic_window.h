// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// Scene, camera, noise and initial errors of a synthetic window.
struct SyntheticWindowOptions {
  SceneKind scene = SceneKind::kRoom;
  uint64_t seed = 1;  ///< Of the scene, the trajectory, the landmarks and the noise.
  PinholeCamera camera;

  int num_keyframes = 8;
  double keyframe_interval = 0.4;  ///< Seconds, at 0.35 m/s.
  int num_fixed = 1;               ///< The first keyframes, fixed at the truth: the gauge.
  /// Maximum number of landmarks; fewer if fewer are visible in at least two keyframes.
  int num_points = 300;
  int num_lines = 60;

  /// Adds noise with the sigmas below, which are those of the observations.
  bool noise = true;
  double point_sigma = 1.0;               ///< Pixels, of each coordinate.
  double line_sigma = 1.0;                ///< Pixels, of an end point's distance to the true line.
  double inverse_depth_sigma = 1.425e-3;  ///< 1/metres, of one depth sample; that of a Kinect.
  bool depth = true;                      ///< Whether points and lines have depth.
  double outlier_ratio = 0.0;             ///< Fraction of observations that are outliers.

  /// Standard deviations of the initial state's error; fixed keyframes have none.
  double start_rotation_sigma = 0.01;     ///< Radians, per axis.
  double start_translation_sigma = 0.02;  ///< Metres, per axis.
  double start_point_sigma = 0.03;        ///< Metres, per axis.
  double start_line_sigma = 0.03;         ///< Metres, per axis and end point.

  bool IsValid(std::string* error) const;
};

struct SyntheticWindow {
  WindowData truth;                  ///< True state, exact observations.
  WindowData data;                   ///< Initial state of a solver, noisy observations.
  std::vector<bool> point_outliers;  ///< One per point observation of `data`.
  std::vector<bool> line_outliers;   ///< One per line observation of `data`.
};

/// Creates a window of observations without images. Keyframes are on a trajectory through a scene;
/// points are where rays of random pixels hit its surfaces; lines are on its edges. A line landmark
/// is the part visible in its first keyframe, and is observed in others as far as it is inside the
/// image and not occluded. Line depths have the covariance of a regression on evenly spaced
/// samples.
///
/// Equal options give equal windows. Throws std::invalid_argument on invalid options.
SyntheticWindow MakeSyntheticWindow(const SyntheticWindowOptions& options);

}  // namespace msc_vo
