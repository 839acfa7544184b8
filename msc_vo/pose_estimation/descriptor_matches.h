// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/matching/local_map.h"

namespace msc_vo {

/// A line of a frame that may be a line of the map, both measured in 3-D.
struct LinePair {
  int feature = 0;
  int candidate = 0;    ///< index in LocalMap::lines
  LineSegment3 in_cam;  ///< metres, camera
  LineSegment3 in_world;
  int distance = 0;  ///< bits, between the descriptors
};

/// Matches every point of `frame` that has a depth with the candidate nearest by descriptor,
/// unless the second nearest is about as near.
std::vector<PointMatch> MatchPointDescriptors(const Frame& frame,
                                              const std::vector<PointCandidate>& candidates);

/// Pairs the longest lines of `frame` whose direction is known in 3-D with the few candidates that
/// are nearest by descriptor: along one edge of a box, several lines look alike.
std::vector<LinePair> MatchLineDescriptors(const Frame& frame,
                                           const std::vector<LineCandidate>& candidates);

}  // namespace msc_vo
