// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map_renumbering.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace msc_vo {

namespace {

// Offsets added to ids.
struct IdOffset {
  KeyframeId keyframe = 0;
  LandmarkId landmark = 0;
  int submap = 0;
};

IdOffset OffsetAfter(const MapContents& contents) {
  IdOffset offset;
  for (const MapSession& session : contents.sessions) {
    offset.keyframe = std::max(offset.keyframe, session.first_keyframe);
  }
  for (const SavedSubMap& submap : contents.submaps) {
    offset.keyframe = std::max(offset.keyframe, submap.map.next_keyframe());
    offset.landmark = std::max(offset.landmark, submap.map.next_landmark());
    offset.submap = std::max(offset.submap, submap.id + 1);
  }
  return offset;
}

template <typename L>
void AddRenumbered(const Map& map, const IdOffset& offset, Map* renumbered) {
  for (const auto& [id, landmark] : map.landmarks<L>()) {
    L copy = landmark;
    copy.id += offset.landmark;
    copy.first_keyframe += offset.keyframe;
    for (Observation& observation : copy.observations) observation.keyframe += offset.keyframe;
    const LandmarkId new_id = copy.id;
    renumbered->AddExisting(std::move(copy));
    renumbered->Refresh<L>(new_id);
  }
}

Map Renumbered(const Map& map, const IdOffset& offset) {
  Map renumbered;
  for (const auto& [id, keyframe] : map.keyframes()) {
    renumbered.AddKeyframe(keyframe.frame, keyframe.cam_from_world, id + offset.keyframe);
    renumbered.SetStepCovariance(id + offset.keyframe, *map.StepCovariance(id));
  }
  ForEachLandmarkKind([&](auto kind) {
    AddRenumbered<typename decltype(kind)::Landmark>(map, offset, &renumbered);
  });
  renumbered.ContinueIds(map.next_keyframe() + offset.keyframe,
                         map.next_landmark() + offset.landmark);
  return renumbered;
}

// Ids of planes are those of a submap.
SavedPlanes Renumbered(SavedPlanes planes, const IdOffset& offset) {
  for (auto& [id, plane] : planes.planes) plane.host += offset.keyframe;
  std::map<KeyframeId, std::vector<PlaneMatch>> observations;
  for (auto& [keyframe, matches] : planes.observations) {
    observations[keyframe + offset.keyframe] = std::move(matches);
  }
  planes.observations = std::move(observations);
  return planes;
}

}  // namespace

KeyframeId RenumberAfter(const MapContents& first, MapContents* second) {
  const IdOffset offset = OffsetAfter(first);
  for (MapSession& session : second->sessions) session.first_keyframe += offset.keyframe;
  for (SavedSubMap& submap : second->submaps) {
    submap.id += offset.submap;
    submap.map = Renumbered(submap.map, offset);
    submap.planes = Renumbered(std::move(submap.planes), offset);
  }
  for (PoseGraphEdge& edge : second->loops) {
    edge.from += offset.keyframe;
    edge.to += offset.keyframe;
  }
  return offset.keyframe;
}

}  // namespace msc_vo
