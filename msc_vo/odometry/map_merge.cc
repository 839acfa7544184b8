// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/map_merge.h"

#include <memory>
#include <utility>

#include "msc_vo/map/map_renumbering.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/mapping/landmark_care.h"
#include "msc_vo/mapping/loop_closer.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/self_calibration/keyframe_intrinsics.h"
#include "msc_vo/tracking/place_search.h"

namespace msc_vo {

namespace {

// Time that a keyframe is searched for, as if it were a frame that comes so long after the one
// before it: ten keyframes of inactive maps are tried.
constexpr double kSearchSeconds = 10.0 / 30.0;

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

// Searches the keyframes of a map in others, as a run does with its own.
class MapMerger {
 public:
  MapMerger(const OdometryOptions& options, MapContents first)
      : options_(EffectiveOptions(options)),
        atlas_(options_.mapping.axes, options_.mapping.noise),
        care_(options_.mapping.culling, options_.mapping.fusion) {
    loops_.AddEdges(first.loops);
    atlas_.BeginWith(std::move(first.submaps));
  }

  void Add(MapContents second) {
    loops_.AddEdges(second.loops);
    for (SavedSubMap& submap : second.submaps) Add(std::move(submap));
  }

  MapMerge Result() {
    MapMerge result;
    result.contents.submaps = atlas_.ShareSubMaps();
    result.contents.loops = loops_.edges();
    result.joins = joins_;
    result.num_loops = loops_.num_closed();
    return result;
  }

 private:
  void Add(SavedSubMap saved) {
    if (!atlas_.current().map.keyframes().empty()) atlas_.Begin(true);
    SubMap& submap = atlas_.current();
    submap.map = std::move(saved.map);
    submap.map.BeginSession();
    if (saved.axes) submap.axes.Restore(*saved.axes);
    submap.noise.Restore(saved.noise_scale);
    joiner_.Clear();
    loops_.Clear();
    std::vector<KeyframeId> keyframes;
    for (const auto& [id, keyframe] : submap.map.keyframes()) keyframes.push_back(id);
    PlaceSearch places(options_.tracking);
    bool is_joined = false;
    for (const KeyframeId id : keyframes) {
      Map* const map = &atlas_.current().map;
      if (map->FindKeyframe(id) == nullptr) continue;  // culled
      const TrackedFrame tracked = AsTracked(id);
      const MapSnapshot snapshot = Snapshot(id);
      places.Update(snapshot);
      const auto revisit = places.FindRevisit(tracked, true, snapshot, kSearchSeconds);
      if (revisit && Use({id, tracked.pose.covariance, *revisit})) is_joined = true;
    }
    if (is_joined) Tidy(keyframes);
  }

  MapSnapshot Snapshot(KeyframeId newest) {
    MapSnapshot snapshot;
    snapshot.map = atlas_.current().map.Share();
    snapshot.world = atlas_.current().id;
    snapshot.inactive_maps = atlas_.inactive_maps();
    snapshot.newest_keyframe = newest;
    snapshot.noise_scale = atlas_.current().noise.scale();
    return snapshot;
  }

  // A keyframe as the frame that it was, tracked in its own map.
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

  // Returns whether it joined two maps.
  bool Use(const KeyframeRevisit& found) {
    Map* const map = &atlas_.current().map;
    if (map->KnowsKeyframe(found.revisit.reference)) {
      loops_.AddRevisit(found);
      loops_.TryClose(map);
      return false;
    }
    joiner_.Add(found);
    const std::optional<MapJoin> join = joiner_.TryJoin(&atlas_);
    if (!join) return false;
    joins_.push_back(*join);
    loops_.Clear();  // the world of the visits may be another
    return true;
  }

  // Both maps have shown the same place: one is enough.
  void Tidy(const std::vector<KeyframeId>& keyframes) {
    Map* const map = &atlas_.current().map;
    for (const KeyframeId id : keyframes) {
      if (map->FindKeyframe(id) == nullptr) continue;
      care_.Fuse(id, map);
      care_.CullKeyframes(id, map);
    }
  }

  OdometryOptions options_;
  Atlas atlas_;
  LandmarkCare care_;
  MapJoiner joiner_;
  LoopCloser loops_;
  std::vector<MapJoin> joins_;
};

}  // namespace

MapMerge MergeMaps(const OdometryOptions& options, MapContents first, MapContents second) {
  if (first.submaps.empty()) return {std::move(second), {}, 0};
  RenumberAfter(first, &second);
  const PinholeCamera camera = first.submaps.front().map.keyframes().front().second.frame->camera;
  for (SavedSubMap& submap : second.submaps) ChangeKeyframeCamera(camera, &submap.map);
  std::vector<MapSession> sessions = std::move(first.sessions);
  sessions.insert(sessions.end(), second.sessions.begin(), second.sessions.end());
  MapMerger merger(options, std::move(first));
  merger.Add(std::move(second));
  MapMerge result = merger.Result();
  result.contents.sessions = std::move(sessions);
  return result;
}

}  // namespace msc_vo
