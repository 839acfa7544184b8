// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/matching/landmark_matchers.h"

namespace msc_vo {

struct FusionOptions {
  MatcherOptions matchers;
  int max_neighbours = 10;  ///< covisible keyframes that are searched; the size of the window
};

/// Matches the landmarks of keyframe `id` with the features of its covisible keyframes, and theirs
/// with its features. A matched feature without a landmark becomes an observation. If it observes
/// another landmark, the two are duplicates and are merged into the one with more observations (the
/// older one on ties).
void FuseLandmarks(const FusionOptions& options, KeyframeId id, Map* map);
/// FuseLandmarks() for every keyframe of the map.
void FuseAllLandmarks(const FusionOptions& options, Map* map);

}  // namespace msc_vo
