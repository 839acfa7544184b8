// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

// Small window for the tests of bundle adjustment and pose optimization: cameras that pass a wall,
// points, and axis-aligned lines. Line i is parallel to axis i % 3. Measurement noise is normal
// with the sigmas of the observations.
struct TestWindowOptions {
  int num_keyframes = 10;
  int num_fixed = 2;
  int num_points = 200;
  int num_lines = 40;
  int max_observations = 10;             // per landmark
  double noise = 1.0;                    // factor on the measurement noise; 0: exact
  double perturbation = 1.0;             // factor on the error of the initial state
  double outlier_ratio = 0.0;            // fraction of observations replaced by outliers
  double fy = 525.0;                     // may be negative
  double point_sigma = 1.0;              // pixels
  double line_sigma = 1.0;               // pixels
  double inverse_depth_sigma = 0.002;    // 1/metres
  double line_depth_correlation = -0.4;  // of the errors at both ends
  bool has_depth = true;
  // Cameras that pass along x on a straight line, and every second line parallel to it: its images
  // show one plane. The others are parallel to y.
  bool lines_along_motion = false;
  // Fraction of observations with an error of 20 px: of points in any direction, of lines at one
  // end. Drawn apart from all other random numbers.
  double gross_error_ratio = 0.0;
  unsigned seed = 1;
};

struct TestWindow {
  WindowData truth;                  // true poses and landmarks, with the observations of `data`
  WindowData data;                   // initial state of the solver
  std::vector<bool> point_outliers;  // per point observation
  std::vector<bool> line_outliers;   // per line observation
};

TestWindow MakeTestWindow(const TestWindowOptions& options);

// Whether both windows have the same poses, points, lines and extra blocks, to the last bit.
bool SameState(const WindowData& a, const WindowData& b);

// Observations of the true landmarks in keyframe `k` of the window. The predicted pose has an error
// of 1 degree and 3 cm.
PoseData MakePoseData(const TestWindow& window, int k);

}  // namespace msc_vo
