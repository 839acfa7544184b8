// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/keyframe_intrinsics.h"

#include <utility>
#include <vector>

namespace msc_vo {

namespace {

// Moves the landmarks of a kind to the positions that the first of their observations with a depth
// measures.
template <typename L>
void MoveLandmarks(Map* map) {
  std::vector<std::pair<LandmarkId, typename L::Geometry>> moved;
  for (const auto& [id, landmark] : map->landmarks<L>()) {
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = *map->FindKeyframe(observation.keyframe);
      if (!FeaturesOf<L>(*keyframe.frame)[observation.feature].HasDepth()) continue;
      moved.emplace_back(id, keyframe.cam_from_world.Inverse() *
                                 L::InCamera(*keyframe.frame, observation.feature));
      break;
    }
  }
  for (const auto& [id, geometry] : moved) map->SetGeometry<L>(id, geometry);
}

}  // namespace

void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map) {
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> frames;
  for (const auto& [id, keyframe] : map->keyframes()) {
    frames.emplace_back(id, update(id, keyframe.frame));
  }
  for (auto& [id, frame] : frames) map->SetFrame(id, std::move(frame));
  ForEachLandmarkKind([map](auto kind) { MoveLandmarks<typename decltype(kind)::Landmark>(map); });
}

}  // namespace msc_vo
