// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

/// Sets the poses of keyframes (cam_from_world). Every landmark moves with the oldest keyframe that
/// observes it.
void MoveKeyframes(const std::map<KeyframeId, Rigid3>& poses, Map* map);

/// Lets keyframe `id` observe the landmarks that its features were matched with in another part of
/// the map. Where a feature has a landmark already, the two are one.
void MergeMatches(KeyframeId id, const FrameMatches& matches, Map* map);

}  // namespace msc_vo
