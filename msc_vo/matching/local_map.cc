// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/local_map.h"

#include <set>
#include <vector>

#include "msc_vo/map/id_set.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

std::set<KeyframeId> SelectKeyframes(const Map& map, const FrameMatches& matches,
                                     KeyframeId fallback, int max_keyframes,
                                     KeyframeId* reference) {
  std::vector<Map::Covisible> ranked = RankObservers(map, matches);
  if (ranked.empty()) ranked.push_back({fallback, 0});
  *reference = ranked.front().keyframe;
  std::set<KeyframeId> selected;
  for (const Map::Covisible& observer : ranked) {
    if (static_cast<int>(selected.size()) >= max_keyframes) return selected;
    selected.insert(observer.keyframe);
  }
  // Covisible keyframes of the best one observe landmarks that are about to enter the view.
  for (const Map::Covisible& covisible : map.FindCovisible(*reference)) {
    if (static_cast<int>(selected.size()) >= max_keyframes) break;
    selected.insert(covisible.keyframe);
  }
  return selected;
}

template <typename L>
void AddIfVisible(const Viewpoint& view, const L& landmark, LocalMap* local) {
  auto candidate = CandidateOf(landmark);
  if (IsVisible(view, landmark, &candidate)) OfKind<L>(*local).push_back(candidate);
}

}  // namespace

PerKind<std::vector<LandmarkId>> IdsOf(const LocalMap& local) {
  PerKind<std::vector<LandmarkId>> ids;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& candidate : OfKind<L>(local)) ids.Of<L>().push_back(candidate.id);
  });
  return ids;
}

std::vector<Map::Covisible> RankObservers(const Map& map, const FrameMatches& matches) {
  ObserverCount observers(map);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : OfKind<L>(matches)) {
      const L* landmark = match.inlier ? map.Find<L>(match.id) : nullptr;
      if (landmark != nullptr) observers.Add(*landmark);
    }
  });
  return observers.Ranked();
}

LocalMap LandmarksOf(const Map& map, const Keyframe& keyframe) {
  LocalMap landmarks;
  landmarks.reference = keyframe.id;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const LandmarkId id : SlotsOf<L>(keyframe)) {
      if (id != kNoId) OfKind<L>(landmarks).push_back(CandidateOf(*map.Find<L>(id)));
    }
  });
  return landmarks;
}

LocalMap SelectLocalMap(const Map& map, const Frame& frame, const Rigid3& cam_from_world,
                        const FrameMatches& matches, KeyframeId fallback, int max_keyframes) {
  LocalMap local;
  const std::set<KeyframeId> keyframes =
      SelectKeyframes(map, matches, fallback, max_keyframes, &local.reference);
  const Viewpoint view(frame, cam_from_world);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    IdSet landmarks(map.landmarks<L>());
    for (const KeyframeId keyframe : keyframes) {
      for (const LandmarkId id : SlotsOf<L>(*map.FindKeyframe(keyframe))) {
        if (id != kNoId) landmarks.Insert(id);
      }
    }
    landmarks.VisitAll([&](const L& landmark) { AddIfVisible(view, landmark, &local); });
  });
  return local;
}

LocalMap SelectVisibleLandmarks(const Map& map, const Frame& frame, const Rigid3& cam_from_world) {
  LocalMap local;
  const Viewpoint view(frame, cam_from_world);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& [id, landmark] : map.landmarks<L>()) AddIfVisible(view, landmark, &local);
  });
  return local;
}

}  // namespace msc_vo
