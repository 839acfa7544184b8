// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/landmark_fusion.h"

namespace msc_vo {

// What differs between the kinds of landmarks in fusion (FuseLandmarks) and culling: points.

/// Matches points that project into a frame with its features.
std::vector<PointMatch> MatchForFusion(const FusionOptions& options, const Frame& frame,
                                       const std::vector<PointCandidate>& candidates);

/// Sets the pyramid level at which the keyframe is expected to show the point.
void SetLevel(const Keyframe& target, const PointLandmark& point, PointCandidate* candidate);

/// Whether the depth of a feature of the keyframe, if it was measured, agrees with the landmark.
bool AgreesWithDepth(const Keyframe& keyframe, int feature, const PointLandmark& point);

/// Whether two landmarks that a feature of the keyframe was matched with are one.
bool AreDuplicates(const Keyframe& keyframe, const PointLandmark& a, const PointLandmark& b);

/// Whether an observation is as fine as a feature: its level is at most one coarser.
inline bool IsAsFine(const PointFeature& other, const PointFeature& feature) {
  return other.level <= feature.level + 1;
}

}  // namespace msc_vo
