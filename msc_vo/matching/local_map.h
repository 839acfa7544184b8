// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

/// The part of the map that is expected to be visible in a frame.
struct LocalMap : ByKind<Candidates> {
  KeyframeId reference = kNoId;  ///< the keyframe that shares most landmarks with the frame
};

/// The landmarks of a local map.
PerKind<std::vector<LandmarkId>> IdsOf(const LocalMap& local);

/// The keyframes that observe the matched landmarks (inliers), most shared landmarks first.
std::vector<Map::Covisible> RankObservers(const Map& map, const FrameMatches& matches);

/// The landmarks of a keyframe as candidates, wherever they would project to: for a search without
/// a prediction. Their pixels and pyramid levels are not set.
LocalMap LandmarksOf(const Map& map, const Keyframe& keyframe);

/// Selects the local map of a frame (paper: local map tracking): the landmarks of the keyframes
/// that share landmarks with `matches`, and of the covisible keyframes of the best of them. A
/// landmark is included if it is expected to be visible (IsVisible) in `frame` from
/// `cam_from_world`. If no match is a landmark, the neighbourhood of keyframe `fallback` is
/// selected. At most `max_keyframes` keyframes contribute.
LocalMap SelectLocalMap(const Map& map, const Frame& frame, const Rigid3& cam_from_world,
                        const FrameMatches& matches, KeyframeId fallback, int max_keyframes);

/// Selects the landmarks of the whole map that are expected to be visible in `frame` from
/// `cam_from_world`, by the criteria of SelectLocalMap(): for a search around a pose that may be
/// far from the last keyframes. The reference is kNoId.
LocalMap SelectVisibleLandmarks(const Map& map, const Frame& frame, const Rigid3& cam_from_world);

}  // namespace msc_vo
