// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/map_merge.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/map/map_renumbering.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/keyframe_graph.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/mapping/loop_closer.h"
#include "msc_vo/mapping/plane_map.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/odometry/input_checks.h"
#include "msc_vo/self_calibration/keyframe_frames.h"
#include "msc_vo/tracking/place_search.h"

namespace msc_vo {

namespace {

// Search budget of a keyframe, seconds since the frame before it: six keyframes of inactive maps
// are tried.
constexpr double kSearchSeconds = 6.0 / 30.0;

void RemoveEmptySubMaps(MapContents* contents) {
  EraseIf(&contents->submaps,
          [](const SavedSubMap& submap) { return submap.map.keyframes().empty(); });
}

// The landmarks that a keyframe observes, without their geometry.
template <typename L>
void AddMatches(const Keyframe& keyframe, Matches<L>* matches) {
  const auto& slots = keyframe.landmarks.Of<L>();
  for (size_t feature = 0; feature < slots.size(); ++feature) {
    if (slots[feature] == kNoId) continue;
    typename Matches<L>::value_type match;
    match.feature = static_cast<int>(feature);
    match.id = slots[feature];
    matches->push_back(match);
  }
}

// Relocalizes the keyframes of maps in those of others.
class MapMerger {
 public:
  MapMerger(const OdometryOptions& options, MapContents first)
      : options_(ValidatedOptions(options)), atlas_(options_.mapping.axes, options_.mapping.noise) {
    loops_.AddEdges(first.loops);
    atlas_.BeginWith(std::move(first.submaps));
  }

  void Add(MapContents second) {
    loops_.AddEdges(second.loops);
    sessions_ = std::move(second.sessions);
    for (SavedSubMap& submap : second.submaps) Add(std::move(submap));
  }

  MapMerge Result() {
    MapMerge result;
    result.contents.submaps = atlas_.ShareSubMaps();
    result.contents.loops = LoopsBetweenKeyframes(result.contents.submaps, loops_.edges());
    result.joins = joins_;
    result.num_loops = loops_.num_closed();
    return result;
  }

 private:
  void Add(SavedSubMap saved) {
    atlas_.BeginWith(std::move(saved));
    joiner_.Clear();
    loops_.Clear();
    std::vector<KeyframeId> keyframes;
    for (const auto& [id, keyframe] : atlas_.current().map.keyframes()) keyframes.push_back(id);
    PlaceSearch places(options_.tracking);
    std::ptrdiff_t session = 0;
    bool is_joined = false;
    for (const KeyframeId id : keyframes) {
      if (SessionOf(id) != session) {
        session = SessionOf(id);
        places = PlaceSearch(options_.tracking);  // times of two sessions cannot be compared
      }
      const TrackedFrame tracked = AsTracked(id);
      const MapSnapshot snapshot = Snapshot(id);
      places.Update(snapshot);
      const auto revisit = places.FindRevisit(tracked, true, snapshot, kSearchSeconds);
      if (!revisit) continue;
      JoinOrClose({id, *atlas_.current().map.StepCovariance(id), *revisit}, &is_joined);
    }
    if (is_joined) FuseAndCull(keyframes);
  }

  MapSnapshot Snapshot(KeyframeId newest) {
    MapSnapshot snapshot;
    snapshot.map = atlas_.current().map.Share();
    snapshot.world = atlas_.current().id;
    snapshot.inactive_maps = atlas_.inactive_maps();
    snapshot.newest_keyframe = newest;
    snapshot.loops = loops_.edges();
    snapshot.noise_scale = atlas_.current().noise.scale();
    return snapshot;
  }

  // The number of sessions of the second map that began up to this keyframe.
  std::ptrdiff_t SessionOf(KeyframeId id) const {
    return std::count_if(sessions_.begin(), sessions_.end(),
                         [id](const MapSession& session) { return session.first_keyframe <= id; });
  }

  // The tracking result of a keyframe in its own map.
  TrackedFrame AsTracked(KeyframeId id) const {
    const Map& map = atlas_.current().map;
    const Keyframe& keyframe = *map.FindKeyframe(id);
    TrackedFrame tracked;
    tracked.frame = keyframe.frame;
    tracked.status = TrackingStatus::kTracked;
    tracked.reference = id;
    tracked.cam_from_world = keyframe.cam_from_world;
    tracked.pose.covariance = CovarianceOfCamera(keyframe.cam_from_world, *map.StepCovariance(id));
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      AddMatches<L>(keyframe, &tracked.matches.Of<L>());
    });
    const LocalMap local =
        SelectLocalMap(map, *keyframe.frame, keyframe.cam_from_world, tracked.matches, id,
                       options_.tracking.max_local_keyframes);
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      for (const auto& candidate : local.Of<L>()) {
        tracked.visible.Of<L>().push_back(candidate.id);
      }
    });
    return tracked;
  }

  // Joins the current map with another one, or closes a loop in it after a join.
  void JoinOrClose(const KeyframeRevisit& found, bool* is_joined) {
    Map* const map = &atlas_.current().map;
    if (map->KnowsKeyframe(found.revisit.reference)) {
      if (!*is_joined) return;  // a loop that its own run has not closed
      loops_.AddRevisit(found);
      loops_.TryClose(map);
      return;
    }
    joiner_.Add(found);
    const SubMap* other = atlas_.FindSubMapOf(found.revisit.reference);
    const SubMapId other_id = other->id;
    const NoiseEstimator noise = other->noise;
    const std::optional<MapJoin> join = joiner_.TryJoin(&atlas_);
    if (!join) return;
    // In a run, both submaps have the noise of its sensor. Here, the older one keeps its own.
    if (join->kept == other_id) atlas_.current().noise = noise;
    joins_.push_back(*join);
    loops_.Clear();  // the world of the visits may be another
    *is_joined = true;
  }

  // Fuses duplicate landmarks and culls redundant keyframes.
  void FuseAndCull(const std::vector<KeyframeId>& keyframes) {
    Map* const map = &atlas_.current().map;
    PlaneMap* const planes = &atlas_.current().planes;
    for (const KeyframeId id : keyframes) {
      if (map->FindKeyframe(id) == nullptr) continue;
      FuseLandmarks(options_.mapping.fusion, id, map);
      planes->MergeDuplicates(*map, id);
      CullKeyframes(options_.mapping.culling, id, map);
    }
    planes->Renew(*map);
  }

  OdometryOptions options_;
  Atlas atlas_;
  MapJoiner joiner_;
  LoopCloser loops_;
  std::vector<MapSession> sessions_;  // of the second map
  std::vector<MapJoin> joins_;
};

}  // namespace

MapMerge MergeMaps(const OdometryOptions& options, MapContents first, MapContents second) {
  const KeyframeId keyframe_offset = RenumberAfter(first, &second);
  RemoveEmptySubMaps(&first);
  RemoveEmptySubMaps(&second);
  if (!first.submaps.empty()) {
    const PinholeCamera camera = first.submaps[0].map.keyframes().front().second.frame->camera;
    for (SavedSubMap& submap : second.submaps) ChangeKeyframeCamera(camera, &submap.map);
  }
  std::vector<MapSession> sessions = std::move(first.sessions);
  sessions.insert(sessions.end(), second.sessions.begin(), second.sessions.end());
  MapMerger merger(options, std::move(first));
  merger.Add(std::move(second));
  MapMerge result = merger.Result();
  result.contents.sessions = std::move(sessions);
  result.keyframe_offset = keyframe_offset;
  return result;
}

}  // namespace msc_vo
