// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_correction.h"

#include <vector>

namespace msc_vo {

namespace {

template <typename L>
void MoveLandmarks(const std::map<KeyframeId, Rigid3>& motions, Map* map) {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : map->landmarks<L>()) ids.push_back(id);
  for (const LandmarkId id : ids) {
    const L& landmark = *map->Find<L>(id);
    const auto motion = motions.find(landmark.observations.front().keyframe);
    if (motion == motions.end()) continue;
    map->SetGeometry<L>(id, motion->second * landmark.geometry());
    map->Refresh<L>(id);
  }
}

template <typename L>
void MergeMatchesOf(KeyframeId id, const FrameMatches& matches, Map* map) {
  for (const auto& match : OfKind<L>(matches)) {
    if (map->Find<L>(match.id) == nullptr) continue;  // merged by an earlier match
    const LandmarkId holder = SlotsOf<L>(*map->FindKeyframe(id))[match.feature];
    if (holder == match.id) continue;
    if (holder == kNoId) {
      map->Observe<L>(match.id, id, match.feature);
    } else {
      map->MergeLandmarks<L>(holder, match.id);
    }
    map->Refresh<L>(match.id);
  }
}

}  // namespace

void MoveKeyframes(const std::map<KeyframeId, Rigid3>& poses, Map* map) {
  std::map<KeyframeId, Rigid3> motions;  // new_from_old_world
  for (const auto& [id, cam_from_world] : poses) {
    motions[id] = cam_from_world.Inverse() * map->CamFromWorld(id);
    map->SetPose(id, cam_from_world);
  }
  ForEachLandmarkKind(
      [&](auto kind) { MoveLandmarks<typename decltype(kind)::Landmark>(motions, map); });
}

void MergeMatches(KeyframeId id, const FrameMatches& matches, Map* map) {
  ForEachLandmarkKind(
      [&](auto kind) { MergeMatchesOf<typename decltype(kind)::Landmark>(id, matches, map); });
}

}  // namespace msc_vo
