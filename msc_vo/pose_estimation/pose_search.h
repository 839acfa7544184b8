// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/matching/local_map.h"
#include "msc_vo/pose_estimation/relocalizer.h"

namespace msc_vo {

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

}  // namespace msc_vo
