// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/keyframe_intrinsics.h"

#include <utility>
#include <vector>

#include "msc_vo/frame/frame_intrinsics.h"

namespace msc_vo {

namespace {

// Moves the landmarks of a kind to the positions that the first of their observations with a depth
// measures, and clears Landmark::has_false_depth, which was found with the calibration so far.
template <typename L>
void MoveLandmarks(Map* map) {
  std::vector<std::pair<LandmarkId, typename L::Geometry>> moved;
  for (const auto& [id, landmark] : map->landmarks<L>()) {
    if (map->IsOfEarlierSession(landmark.observations.front().keyframe)) continue;
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = *map->FindKeyframe(observation.keyframe);
      if (!FeaturesOf<L>(*keyframe.frame)[observation.feature].HasDepth()) continue;
      moved.emplace_back(id, keyframe.cam_from_world.Inverse() *
                                 L::InCamera(*keyframe.frame, observation.feature));
      break;
    }
  }
  for (const auto& [id, geometry] : moved) {
    map->SetGeometry<L>(id, geometry);
    map->SetHasFalseDepth<L>(id, false);
  }
}

template <typename L>
void RefreshAll(Map* map) {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : map->landmarks<L>()) ids.push_back(id);
  for (const LandmarkId id : ids) map->Refresh<L>(id);
}

void ReplaceFrames(const KeyframeUpdate& update, Map* map) {
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> frames;
  for (const auto& [id, keyframe] : map->keyframes()) {
    std::shared_ptr<const Frame> frame = update(id, keyframe.frame);
    if (frame != keyframe.frame) frames.emplace_back(id, std::move(frame));
  }
  for (auto& [id, frame] : frames) map->SetFrame(id, std::move(frame));
}

}  // namespace

void ChangeKeyframeCamera(const PinholeCamera& camera, Map* map) {
  ReplaceFrames(
      [&](KeyframeId /*id*/, const std::shared_ptr<const Frame>& frame) {
        return ChangeCamera(frame, camera);
      },
      map);
  // The distance at which a patch has the size of a pyramid level depends on the camera.
  ForEachLandmarkKind([map](auto kind) { RefreshAll<typename decltype(kind)::Landmark>(map); });
}

void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map) {
  ReplaceFrames(update, map);
  ForEachLandmarkKind([map](auto kind) { MoveLandmarks<typename decltype(kind)::Landmark>(map); });
}

}  // namespace msc_vo
