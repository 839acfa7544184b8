// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

/// A keyframe that was found in another part of the maps.
struct KeyframeRevisit {
  KeyframeId keyframe = kNoId;
  /// Of its pose in its own map, in the camera frame (CameraCovariance()).
  PoseCovariance covariance = PoseCovariance::Zero();
  Revisit revisit;
};

/// The poses of the keyframe in both maps, which may be parts of one. a: `own`, that of the
/// keyframe; b: `other`, that of the reference.
FrameInTwoMaps InTwoMaps(const KeyframeRevisit& found, const Map& own, const Map& other);

/// Appends a keyframe and removes the oldest one if there are more than ten: older keyframes have
/// drifted more, and wrong ones must not outvote the others for ever.
void AddRecent(const KeyframeRevisit& found, std::vector<KeyframeRevisit>* recent);

}  // namespace msc_vo
