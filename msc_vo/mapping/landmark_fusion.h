// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

/// Search radius around a projected landmark, pixels at level 0. Both poses are estimated, so that
/// the landmark's own error remains: about three sigmas of a feature.
constexpr double kFusionRadius = 3.0;

struct FusionOptions {
  PointMatcherOptions point_matcher;
  LineMatcherOptions line_matcher;
  int max_neighbours = 10;  ///< covisible keyframes that are searched; the size of the window

  bool IsValid(std::string* error) const;
};

/// Matches the landmarks of keyframe `id` with the features of its covisible keyframes, and theirs
/// with its features. A matched feature without a landmark becomes an observation. If it observes
/// another landmark, the two are duplicates and are merged into the one with more observations (the
/// older one on ties).
void FuseLandmarks(const FusionOptions& options, KeyframeId id, Map* map);
/// FuseLandmarks() for every keyframe of the map.
void FuseAllLandmarks(const FusionOptions& options, Map* map);

}  // namespace msc_vo
