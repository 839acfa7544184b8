// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/local_map.h"

namespace msc_vo {

struct RelocalizerOptions {
  /// Points, and twice the lines, that support a pose: more than chance yields among some hundred
  /// wrong matches.
  int min_inliers = 12;
};

struct Relocalization {
  Rigid3 cam_from_world;
  FrameMatches matches;  ///< inliers only
  /// Support by the matches: each point counts one at most, less with a larger error, and each line
  /// LineLandmark::kSupport.
  double score = 0.0;
};

/// Finds poses of `frame` against `candidates`, points and lines in the world, without a
/// prediction. Hypotheses come from minimal sets of features that look alike: two lines, a line and
/// a point, or three points, each measured in 3-D in the frame. Every hypothesis is scored by the
/// points that it explains among those matched by descriptor, and by all lines that it explains
/// (`line_matcher`). Returns poses with enough support that explain most features by
/// different landmarks, the best supported first, at most `max_poses`. Deterministic: the random
/// numbers are seeded with the frame's id.
std::vector<Relocalization> FindPoses(const RelocalizerOptions& options,
                                      const LineMatcherOptions& line_matcher, const Frame& frame,
                                      const LocalMap& candidates, int max_poses);

/// Finds the pose of `frame` from the landmarks of one keyframe without a prediction (FindPoses).
/// Returns std::nullopt if too few features agree, or if about as many agree with another pose, as
/// on a box that looks alike from two sides.
std::optional<Relocalization> Relocalize(const RelocalizerOptions& options,
                                         const LineMatcherOptions& line_matcher, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe);

}  // namespace msc_vo
