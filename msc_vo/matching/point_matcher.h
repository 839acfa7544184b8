// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct PointMatcherOptions {
  // Descriptors of one point seen twice differ in fewer bits than this; unrelated ones differ in
  // 128 +- 15 bits or, on repetitive texture, somewhat less.
  int max_distance = 80;
  // The best candidate must be better than the second best by this factor, unless they are
  // neighbours on different levels (the same corner seen at two scales).
  double max_ratio = 0.9;
  // Levels may differ from the predicted one by this many steps of 1.2.
  int max_level_difference = 1;

  bool IsValid(std::string* error) const;
};

// Something that should be seen in a frame: a landmark, or a measured point of another frame.
struct PointCandidate {
  LandmarkId id = kNoId;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
  Descriptor descriptor{};
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // where it projects, pixels
  int level = 0;                                    // pyramid level at which it should appear
};

// Projects `position`; returns false if it falls outside the image or behind the camera.
bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      PointCandidate* candidate);

// Matches candidates with the features of `frame` within `radius` pixels (at level 0; it grows with
// the level) by descriptor. A feature goes to the candidate with the smallest distance, the first
// of equals. Features that move and those with `taken[feature]` are left out; `taken` may be empty.
std::vector<PointMatch> MatchPoints(const PointMatcherOptions& options, const Frame& frame,
                                    const std::vector<PointCandidate>& candidates, double radius,
                                    const std::vector<bool>& taken);

}  // namespace msc_vo
