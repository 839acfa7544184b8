// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/landmark_fusion.h"

namespace msc_vo {

// What differs between the kinds of landmarks in fusion (FuseLandmarks): points.

/// Matches the points of keyframe `source` with the features of keyframe `target`.
std::vector<PointMatch> MatchForFusion(LandmarkKind<PointLandmark> kind,
                                       const FusionOptions& options, const Map& map,
                                       const Keyframe& source, const Keyframe& target);

/// Whether the depth of a feature of the keyframe, if it was measured, agrees with the landmark.
bool AgreesWithDepth(const Keyframe& keyframe, int feature, const PointLandmark& point);

/// Whether two landmarks that a feature of the keyframe was matched with are one.
bool AreDuplicates(const Keyframe& keyframe, const PointLandmark& a, const PointLandmark& b);

}  // namespace msc_vo
