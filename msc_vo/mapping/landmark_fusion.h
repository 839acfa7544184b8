// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

struct FusionOptions {
  PointMatcherOptions point_matcher;
  LineMatcherOptions line_matcher;
  int max_neighbours = 10;  // keyframes that are searched: the size of the window
  // Pixels between a projected landmark and the feature that shows it, at level 0: both poses are
  // estimated, so what is left is the landmark's own error, about three sigmas of a feature.
  double radius = 3.0;
  // Two line landmarks are one if their directions differ by less than this (degrees) in space, and
  // the middle of each lies this near to the other, relative to its distance from the camera.
  double max_line_angle = 5.0;
  double max_line_offset = 0.02;

  bool IsValid(std::string* error) const;
};

// Looks for the landmarks of keyframe `id` in its neighbours, and for the neighbours' landmarks in
// it. Where a free feature shows the landmark it becomes an observation; where the feature belongs
// to another landmark, the two are duplicates and the one seen more often (the older of equals)
// stays.
void FusePoints(const FusionOptions& options, KeyframeId id, Map* map);
void FuseLines(const FusionOptions& options, KeyframeId id, Map* map);

}  // namespace msc_vo
