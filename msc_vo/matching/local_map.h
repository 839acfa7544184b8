// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

// The part of the map that a frame should see.
struct LocalMap {
  KeyframeId reference = kNoId;  // the keyframe that shares most landmarks with the frame
  std::vector<PointCandidate> points;
  std::vector<LineCandidate> lines;
};

// The landmarks of the keyframes that share landmarks with `matches`, and of the neighbours of the
// best of them, as far as they project into `frame` from `cam_from_world`, are seen from a similar
// direction, and (points) at a scale that the pyramid covers. If no match is a landmark, the
// neighbourhood of keyframe `fallback` is taken.
LocalMap SelectLocalMap(const Map& map, const Frame& frame, const Rigid3& cam_from_world,
                        const FrameMatches& matches, KeyframeId fallback, int max_keyframes);

}  // namespace msc_vo
