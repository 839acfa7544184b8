// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/landmark_fusion.h"

namespace msc_vo {

// What differs between the kinds of landmarks in fusion (FuseLandmarks): lines.

/// Matches the lines of keyframe `source` with the features of keyframe `target`.
std::vector<LineMatch> MatchForFusion(LandmarkKind<LineLandmark> kind, const FusionOptions& options,
                                      const Map& map, const Keyframe& source,
                                      const Keyframe& target);

/// Whether the depth of a feature of the keyframe, if it was measured, agrees with the landmark.
bool AgreesWithDepth(const Keyframe& keyframe, int feature, const LineLandmark& line);

/// Whether two landmarks that a feature of the keyframe was matched with are one.
bool AreDuplicates(const Keyframe& keyframe, const LineLandmark& a, const LineLandmark& b);

}  // namespace msc_vo
