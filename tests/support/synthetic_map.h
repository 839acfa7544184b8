// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/map.h"
#include "msc_vo/map/snapshot.h"

namespace msc_vo {

// Adds a keyframe in which every feature of `frame` with a depth is a new landmark. `id`: see
// Map::AddKeyframe().
inline void AddKeyframe(const std::shared_ptr<const Frame>& frame, const Rigid3& cam_from_world,
                        MapSnapshot* snapshot, KeyframeId id = kNoId) {
  id = snapshot->map.AddKeyframe(frame, cam_from_world, id);
  const Rigid3 world_from_cam = cam_from_world.Inverse();
  for (int i = 0; i < static_cast<int>(frame->points.size()); ++i) {
    if (!frame->points[i].HasDepth()) continue;
    snapshot->map.Add<PointLandmark>(id, i, world_from_cam * frame->PointInCamera(i));
  }
  for (int i = 0; i < static_cast<int>(frame->lines.size()); ++i) {
    if (!frame->lines[i].depth) continue;
    snapshot->map.Add<LineLandmark>(id, i, world_from_cam * frame->LineInCamera(i));
  }
  snapshot->newest_keyframe = id;
}

inline MapSnapshot MapOfOneKeyframe(const std::shared_ptr<const Frame>& frame,
                                    const Rigid3& cam_from_world, KeyframeId id = kNoId) {
  MapSnapshot snapshot;
  AddKeyframe(frame, cam_from_world, &snapshot, id);
  return snapshot;
}

// Distance (metres) and angle (radians) between two poses.
inline double PositionError(const Rigid3& a, const Rigid3& b) {
  return (a.OriginInSource() - b.OriginInSource()).norm();
}
inline double RotationError(const Rigid3& a, const Rigid3& b) {
  return Eigen::Quaterniond(a.rotation()).angularDistance(Eigen::Quaterniond(b.rotation()));
}

}  // namespace msc_vo
