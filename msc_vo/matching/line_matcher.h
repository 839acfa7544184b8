// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct LineMatcherOptions {
  // Largest difference of direction in the image, degrees. Directed: a segment runs with its
  // brighter side always on the same hand, so the two edges of a thin bar are told apart.
  double max_angle = 8.0;
  // Share of the shorter segment that must lie beside the other one.
  double min_overlap = 0.5;
  // LBD descriptors of one line seen twice differ in fewer bits than this.
  int max_distance = 80;
  // Along one stretch of edge several fragments pass the gates; among them descriptor and position
  // decide together: this many bits weigh as much as one pixel of distance.
  double bits_per_pixel = 5.0;

  bool IsValid(std::string* error) const;
};

// A segment that should be seen in a frame.
struct LineCandidate {
  LandmarkId id = kNoId;
  LineSegment3 segment;  // metres, world
  Descriptor descriptor{};
  LineSegment2 image;  // its visible part, pixels
};

// Projects `segment` and clips it to the image; returns false if nothing is visible or the visible
// part is too short (pixels) to have a direction.
bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      LineCandidate* candidate);

// Matches candidates with the lines of `frame` whose distance at the middle of the overlap is below
// `radius` pixels. A feature goes to the candidate with the lowest cost, the first of equals.
// Features that move and those with `taken[feature]` are left out; `taken` may be empty.
std::vector<LineMatch> MatchLines(const LineMatcherOptions& options, const Frame& frame,
                                  const std::vector<LineCandidate>& candidates, double radius,
                                  const std::vector<bool>& taken);

}  // namespace msc_vo
