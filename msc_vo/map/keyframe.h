// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// A frame that is kept in the map, its pose, and the landmarks that its features observe.
struct Keyframe {
  KeyframeId id = kNoId;
  std::shared_ptr<const Frame> frame;
  Rigid3 cam_from_world;
  std::vector<LandmarkId> points;  ///< one per point feature; kNoId: none
  std::vector<LandmarkId> lines;   ///< one per line feature

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, id, frame, cam_from_world, points, lines);
  }
};

}  // namespace msc_vo
