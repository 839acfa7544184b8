// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

struct WindowSelectionOptions {
  /// Keyframes that are optimised: the current one and its most covisible ones.
  int max_keyframes = 10;
  /// Keyframes outside the window that observe its landmarks and are held fixed, most shared
  /// landmarks first. Further ones add cost but little information.
  int max_fixed_keyframes = 10;
  /// Smallest number of observations of a landmark. One observation adds as many unknowns as
  /// equations, apart from its depth.
  int min_observations = 2;
};

/// What makes a keyframe part of a window.
enum class WindowLinks {
  kLandmarks,
  /// Also the keyframe before each keyframe of the window, if they share too few landmarks:
  /// measurements of the motion link them where the map does not. The window may then exceed
  /// `max_keyframes`.
  kLandmarksAndTime,
};

/// Selects the window around `keyframe` (paper: K_c, K_f, P, L of Local Map Optimization) as plain
/// data. The first keyframe of the map, which defines the world, is fixed if it is in the window.
/// If no other keyframe is fixed, the oldest keyframe of the window fixes the gauge.
WindowData SelectWindow(const WindowSelectionOptions& options, const Map& map, KeyframeId keyframe,
                        WindowLinks links = WindowLinks::kLandmarks);

/// Selects all lines with enough observations of a map that is not empty, and all keyframes, which
/// are fixed.
WindowData SelectLines(const WindowSelectionOptions& options, const Map& map);
/// Selects the keyframes of the present session, at least one. Those of earlier ones are fixed, or
/// left out.
WindowData SelectSession(const WindowSelectionOptions& options, const Map& map);

/// The observation of a landmark by feature `feature` of a keyframe, as a record of a window:
/// without a depth if that is false (Landmark::has_false_depth).
WindowData::PointObservation MakeObservation(const Keyframe& keyframe, const PointLandmark& point,
                                             int feature);
WindowData::LineObservation MakeObservation(const Keyframe& keyframe, const LineLandmark& line,
                                            int feature);

/// Writes the optimised window back into the map. Landmarks that one keyframe alone observes, which
/// the window need not have, move with it. Removes rejected observations and lines shorter than 1
/// cm. End points of lines are recomputed from the observations, because bundle adjustment leaves
/// them free along the line.
void WriteBack(const WindowData& window, Map* map);

/// Returns the part of the infinite line of `segment` (world) that the keyframes observe: the union
/// of the observed image segments, projected onto the line. Observations along the line are
/// ignored.
LineSegment3 TrimToObservations(const Map& map, const LineLandmark& line,
                                const LineSegment3& segment);

}  // namespace msc_vo
