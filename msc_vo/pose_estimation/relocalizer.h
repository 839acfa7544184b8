// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/matching/line_matcher.h"

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

/// Finds the pose of `frame` from the landmarks of one keyframe without a prediction (FindPoses).
/// Returns std::nullopt if too few features agree, or if about as many agree with another pose, as
/// on a box that looks alike from two sides.
std::optional<Relocalization> Relocalize(const RelocalizerOptions& options,
                                         const LineMatcherOptions& line_matcher, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe);

}  // namespace msc_vo
