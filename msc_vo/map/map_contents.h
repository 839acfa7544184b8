// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/map/plane_landmark.h"
#include "msc_vo/map/pose_graph_edge.h"
#include "msc_vo/map/snapshot.h"

namespace msc_vo {

/// A run of the odometry that added keyframes to a map.
struct MapSession {
  /// Its keyframes have this id or a higher one, up to those of the next session. Time stamps of
  /// different sessions cannot be compared.
  KeyframeId first_keyframe = 0;
  std::string name;  ///< for people, such as the name of the sequence
};

/// The keyframes of one session in one world.
struct SessionPath {
  std::string name;                    ///< of the session
  int world = 0;                       ///< number of the world that the poses refer to
  std::vector<Rigid3> world_from_cam;  ///< in order of time
};

/// A map in a world of its own, as it outlives a run.
struct SavedSubMap {
  int id = 0;  ///< of its world; the smaller of two is kept when they are joined
  Map map;
  std::optional<AxesEstimate> axes;
  NoiseScale noise_scale;
  SavedPlanes planes = {};  ///< ids are those of this submap
};

/// All that is kept of the runs that have built a map. Ids of keyframes and landmarks are unique
/// over all submaps. Calibrations belong to the frames of the keyframes.
struct MapContents {
  std::vector<MapSession> sessions;  ///< in order of their keyframes; at least one
  std::vector<SavedSubMap> submaps;  ///< by ascending id
  std::vector<PoseGraphEdge> loops;  ///< of the keyframes that closed loops
};

/// The submap with this id, of constant or other contents; nullptr if there is none.
template <typename Contents>
auto FindSubMap(Contents& contents, int64_t id) -> decltype(contents.submaps.data()) {
  for (auto& submap : contents.submaps) {
    if (submap.id == id) return &submap;
  }
  return nullptr;
}

/// Removes the last session if none of its keyframes is in the submaps.
inline void LeaveOutEmptySession(MapContents* contents) {
  const KeyframeId first = contents->sessions.back().first_keyframe;
  for (const SavedSubMap& submap : contents->submaps) {
    const auto& keyframes = submap.map.keyframes();
    if (!keyframes.empty() && keyframes.back().first >= first) return;
  }
  contents->sessions.pop_back();
}

/// The keyframe in any of the submaps; nullptr if there is none with this id.
inline const Keyframe* FindKeyframe(const MapContents& contents, KeyframeId id) {
  for (const SavedSubMap& submap : contents.submaps) {
    if (const Keyframe* found = submap.map.FindKeyframe(id)) return found;
  }
  return nullptr;
}

}  // namespace msc_vo
