// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark_kinds.h"

namespace msc_vo {

/// A frame that is kept in the map, its pose, and the landmarks that its features observe.
struct Keyframe {
  KeyframeId id = kNoId;
  std::shared_ptr<const Frame> frame;
  Rigid3 cam_from_world;
  PerKind<std::vector<LandmarkId>> landmarks;  ///< one per feature; kNoId: none
};

/// The landmarks of a kind that a keyframe observes, one per feature; kNoId: none.
template <typename L>
const std::vector<LandmarkId>& SlotsOf(const Keyframe& keyframe) {
  return keyframe.landmarks.Of<L>();
}

}  // namespace msc_vo
