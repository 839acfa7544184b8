// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

struct WindowSelectionOptions {
  // Optimised keyframes: the current one and its most covisible ones.
  int max_keyframes = 10;
  // Keyframes that only observe the window's landmarks and stay fixed, most shared first; the
  // others add cost but hardly information.
  int max_fixed_keyframes = 10;
  // A keyframe belongs to the window if it shares at least this many landmarks with the current
  // one.
  int min_shared = 10;
  // A landmark seen once brings three unknowns and, but for its depth, no equation.
  int min_observations = 2;

  bool IsValid(std::string* error) const;
};

// The window around `keyframe` (paper: K_c, K_f, P, L of Local Map Optimization) as plain data. The
// first keyframe of the map is fixed if it is in the window: it defines the world. If nothing else
// holds the gauge, the oldest keyframe of the window is fixed.
WindowData SelectWindow(const WindowSelectionOptions& options, const Map& map, KeyframeId keyframe);

// Writes the refined state back and forgets rejected observations. Lines are re-cut to what their
// observations show of them: the solver leaves their end points free along the line.
void WriteBack(const WindowData& window, Map* map);

// The part of the infinite line of `segment` (world) that the keyframes see: union of the observed
// image segments, projected onto the line. Observations that look along the line do not count.
LineSegment3 CutToObservations(const Map& map, const LineLandmark& line,
                               const LineSegment3& segment);

}  // namespace msc_vo
