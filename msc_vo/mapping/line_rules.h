// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/landmark_fusion.h"

namespace msc_vo {

// What differs between the kinds of landmarks in fusion (FuseLandmarks) and culling: lines.

/// Matches lines that project into a frame with its features.
std::vector<LineMatch> MatchForFusion(const FusionOptions& options, const Frame& frame,
                                      const std::vector<LineCandidate>& candidates);

/// Lines have no pyramid level.
void SetLevel(const Keyframe& target, const LineLandmark& line, LineCandidate* candidate);

/// Whether the depth of a feature of the keyframe, if it was measured, agrees with the landmark.
bool AgreesWithDepth(const Keyframe& keyframe, int feature, const LineLandmark& line);

/// Whether two landmarks that a feature of the keyframe was matched with are one.
bool AreDuplicates(const Keyframe& keyframe, const LineLandmark& a, const LineLandmark& b);

/// Whether an observation is as fine as a feature: lines have no levels.
inline bool IsAsFine(const LineFeature& /*other*/, const LineFeature& /*feature*/) { return true; }

}  // namespace msc_vo
