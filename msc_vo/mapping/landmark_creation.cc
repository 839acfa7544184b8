// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_creation.h"

namespace msc_vo {

void CreatePoints(KeyframeId id, Probation* probation, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);  // a copy: adding landmarks changes it
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  for (size_t i = 0; i < keyframe.points.size(); ++i) {
    const int feature = static_cast<int>(i);
    const PointFeature& point = keyframe.frame->points[i];
    if (keyframe.points[i] != kNoId || !point.HasDepth() || point.dynamic) continue;
    probation->points.insert(
        map->AddPoint(id, feature, world_from_cam * keyframe.frame->PointInCamera(feature)));
  }
}

void CreateLines(KeyframeId id, Probation* probation, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);  // a copy: adding landmarks changes it
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  for (size_t i = 0; i < keyframe.lines.size(); ++i) {
    const int feature = static_cast<int>(i);
    const LineFeature& line = keyframe.frame->lines[i];
    if (keyframe.lines[i] != kNoId || !line.depth || line.dynamic) continue;
    probation->lines.insert(
        map->AddLine(id, feature, world_from_cam * keyframe.frame->LineInCamera(feature)));
  }
}

}  // namespace msc_vo
