// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

struct RelocalizerOptions {
  int max_distance = 64;     // bits; stricter than with a predicted position, which excludes most
  double max_ratio = 0.8;    // best over second best descriptor distance
  int max_iterations = 200;  // three pairs, 30 % good: 99.6 % to find a clean sample
  int min_inliers = 12;      // more than chance gives among some hundred false matches
  // A pair agrees if it reprojects within this many sigmas (99 % of a chi with 2 degrees).
  double inlier_sigmas = 3.035;

  bool IsValid(std::string* error) const;
};

struct Relocalization {
  Rigid3 cam_from_world;
  FrameMatches matches;  // with landmarks, all of them inliers
};

// Finds the pose of `frame` from the landmarks of one keyframe without any prediction: descriptor
// matching, then RANSAC over triples of 3-D/3-D pairs, scored by reprojection. Deterministic:
// seeded with the frame's id. std::nullopt if too few pairs agree.
std::optional<Relocalization> Relocalize(const RelocalizerOptions& options, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe);

}  // namespace msc_vo
