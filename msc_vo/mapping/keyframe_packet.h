// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/frame.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/structure/axis_evidence.h"

namespace msc_vo {

// In how many frames a landmark should have been seen, and in how many it was.
struct TrackingCount {
  int num_visible = 0;
  int num_found = 0;
};

// What goes from tracking down to the mapper: plain data, nothing shared that changes.
struct KeyframePacket {
  std::shared_ptr<const Frame> frame;
  KeyframeId reference = kNoId;  // kNoId: the first keyframe, cam_from_reference is cam_from_world
  Rigid3 cam_from_reference;
  FrameMatches matches;  // with landmarks of the map
  // Of the keyframe before this one, as the frame after it showed; none if that was not found.
  std::optional<CameraVelocity> last_velocity;
  // Normals of the surfaces in view, camera frame; empty if the map has its axes already.
  std::vector<AxisEvidence> normals;
  // Of all frames since the last packet, this one included.
  std::map<LandmarkId, TrackingCount> point_counts;
  std::map<LandmarkId, TrackingCount> line_counts;
};

}  // namespace msc_vo
