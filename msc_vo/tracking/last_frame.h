// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// What the next frame is tracked from: the last one whose pose was estimated, or that began a new
/// part of the map.
struct LastFrame {
  std::shared_ptr<const Frame> frame;
  /// kNoId: it began a map that was not there yet, and cam_from_reference is cam_from_world.
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
  FrameMatches matches;
  KeyframeId keyframe = kNoId;  ///< the keyframe that it is to become, or has become; kNoId: none

  LastFrame() = default;
  explicit LastFrame(const TrackedFrame& tracked);

  /// Takes over the calibration of the map and, if the newest keyframe was created from the frame,
  /// its pose and its landmarks. That keyframe has a frame of its own, whose lines the mapper may
  /// have refined.
  void UpdateTo(const MapSnapshot& snapshot);

  /// The pose, with the reference as in `map`.
  Rigid3 CamFromWorld(const Map& map) const {
    if (reference == kNoId) return cam_from_reference;
    return cam_from_reference * map.CamFromWorld(reference);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [of_frame, of_reference, of_pose, of_matches, of_keyframe] = *this;  // all members
    archive(of_frame, of_reference, of_pose, of_matches, of_keyframe);
  }
};

}  // namespace msc_vo
