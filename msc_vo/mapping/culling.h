// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <set>

#include "msc_vo/map/map.h"

namespace msc_vo {

struct CullingOptions {
  /// Number of keyframes after its creation during which a landmark is on probation. A landmark
  /// that one keyframe alone observes by then is removed.
  int probation_keyframes = 2;
  /// Smallest ratio of the frames that matched a landmark on probation to those in which it was
  /// predicted to be visible.
  double min_found_ratio = 0.25;
  /// A keyframe is redundant if more than this fraction of its landmarks is observed by three other
  /// keyframes, points at most one pyramid level coarser.
  double redundant_ratio = 0.9;
};

/// Landmarks on probation.
using Probation = PerKind<std::set<LandmarkId>>;

/// Creates a landmark on probation from every feature of `keyframe` that has a depth and no
/// landmark, except on dynamic objects.
void CreateLandmarks(KeyframeId keyframe, Probation* probation, Map* map);

/// Removes the landmarks on probation that fail the tests of CullingOptions, and ends the probation
/// of those that pass.
void CullLandmarks(const CullingOptions& options, KeyframeId newest, Probation* probation,
                   Map* map);

/// Removes redundant keyframes among those covisible with `newest`, except `newest`, its
/// predecessor and the first keyframe, which defines the world. Returns their number.
int CullKeyframes(const CullingOptions& options, KeyframeId newest, Map* map);

}  // namespace msc_vo
