// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <set>
#include <string>

#include "msc_vo/map/map.h"

namespace msc_vo {

// A landmark is on probation until this many keyframes after the one that created it; if it has
// been observed less often by then, it was noise, or is of no use.
struct ProbationOptions {
  int keyframes = 2;
  int min_observations = 2;

  bool IsValid(std::string* error) const;
};

struct CullingOptions {
  ProbationOptions points;
  // The depth of a line is that of a surface beside it where its own was hardly measured, and some
  // frames later it is as wrong: in a corridor and four rooms, lines that three to five keyframes
  // had seen were off by 18 mm, those that eight or more had seen by 8.5 (RMSE). Points gain
  // nothing from a longer probation: RPE over 24 sequences is 4 % larger with four keyframes and
  // three observations (docs/experiments.md).
  ProbationOptions lines{5, 4};
  // A landmark that is seen in fewer of the frames that should show it is not what it seems.
  double min_found_ratio = 0.25;
  // A keyframe is redundant if this share of its landmarks is seen by three other keyframes at the
  // same or a finer scale: what it shows is known without it.
  double redundant_share = 0.9;
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
