// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/window_residuals.h"
#include "msc_vo/problems/window_problem.h"

namespace msc_vo {

struct LandmarkNoiseOptions {
  bool enabled = true;
  // Residuals that a noise of 1 counts as, before any are seen: the degrees of freedom of Student's
  // distribution. With 1, 2 and 3 the geometric mean of the errors of the ten rendered sequences
  // was 0.78, 0.74 and 0.76 mm; before offsets of depth 0.81 with 2, 0.84 with 5 and 1.09 without.
  double prior = 2.0;
  // Metres, of what the depths of a line are off in all views alike: the thickness of a door's
  // casing, a rounded edge. With 0.0025, 0.004 and 0.006 the geometric mean of the errors of the
  // ten rendered sequences was 0.81, 0.74 and 0.75 mm, without 0.81.
  double depth_offset_sigma = 0.005;

  bool IsValid(std::string* error) const;
};

// Landmarks are not alike: the printed corner is found to a tenth of the pixel that a leaf is found
// to, and the outline of something round is another line from every side. So every landmark has a
// noise of its own, by which the sigmas of all its observations are multiplied. Residuals r_i of a
// landmark, in the sigmas that its features came with, then have Student's distribution, and the
// noise that makes them most likely is
//
//   noise^2 = (prior + sum r_i^2) / (prior + n - p),   n residuals, p parameters of the landmark.
//
// A loss on single residuals does not do this: an outline is off by one or two sigmas, but always.
//
// Likewise the depths of a line have an offset of its own, LineLandmark::depth_offset: a mean over
// many views removes their noise, but not that edges of depth and of colour are different edges.

// Multiplies the sigmas of the window's observations, and takes the offsets off depths of lines.
// All landmarks of the window must be in the map.
void ApplyLandmarkNoise(const Map& map, WindowData* window);

// Learns from the same window when it is solved with `window_options`: writes noise and offsets of
// its landmarks to the map. Rejected observations do not count, and no depths that fail the
// chi-square test of `window_options` for an observation with one row of depth.
void LearnLandmarkNoise(const LandmarkNoiseOptions& options, const WindowOptions& window_options,
                        const WindowResiduals& residuals, Map* map);

}  // namespace msc_vo
