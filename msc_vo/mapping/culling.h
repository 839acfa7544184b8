// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <set>
#include <string>

#include "msc_vo/map/map.h"

namespace msc_vo {

struct CullingOptions {
  // A landmark is on probation until this many keyframes after the one that created it; if by then
  // no second keyframe has seen it, it was noise, or is of no use.
  int probation_keyframes = 2;
  int min_observations = 2;
  // A landmark that is seen in fewer of the frames that should show it is not what it seems.
  double min_found_ratio = 0.25;
  // A keyframe is redundant if this share of its landmarks is seen by three other keyframes at the
  // same or a finer scale: what it shows is known without it.
  double redundant_ratio = 0.9;
  int redundant_observers = 3;

  bool IsValid(std::string* error) const;
};

// Landmarks that have not proved themselves yet.
struct Probation {
  std::set<LandmarkId> points;
  std::set<LandmarkId> lines;
};

// Removes bad landmarks among those on probation; lets go of those that passed.
void CullLandmarks(const CullingOptions& options, KeyframeId newest, Probation* probation,
                   Map* map);

// Removes redundant keyframes among the neighbours of `newest`; never it, its predecessor, nor the
// first keyframe, which defines the world. Returns how many.
int CullKeyframes(const CullingOptions& options, KeyframeId newest, Map* map);

}  // namespace msc_vo
