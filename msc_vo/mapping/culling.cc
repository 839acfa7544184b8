// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/culling.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "msc_vo/map/keyframe_index.h"

namespace msc_vo {

namespace {

// Observations that confirm a landmark: that of a second keyframe.
constexpr int kMinObservations = 2;
// Other keyframes that must observe a landmark of a redundant keyframe, as in ORB-SLAM.
constexpr int kRedundantObservers = 3;

template <typename L>
void CreateKind(const Keyframe& keyframe, std::set<LandmarkId>* probation, Map* map) {
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  const auto& features = FeaturesOf<L>(*keyframe.frame);
  for (size_t i = 0; i < features.size(); ++i) {
    const int feature = static_cast<int>(i);
    if (SlotsOf<L>(keyframe)[i] != kNoId || !features[i].HasDepth() || features[i].dynamic) {
      continue;
    }
    probation->insert(
        map->Add<L>(keyframe.id, feature, world_from_cam * L::InCamera(*keyframe.frame, feature)));
  }
}

enum class ProbationState { kPending, kPassed, kFailed };

ProbationState Evaluate(const CullingOptions& options, KeyframeId newest,
                        const Landmark& landmark) {
  if (landmark.num_found < options.min_found_ratio * landmark.num_visible)
    return ProbationState::kFailed;
  if (newest - landmark.first_keyframe < options.probation_keyframes)
    return ProbationState::kPending;
  const int num_observations = static_cast<int>(landmark.observations.size());
  return num_observations >= kMinObservations ? ProbationState::kPassed : ProbationState::kFailed;
}

template <typename L>
void CullKind(const CullingOptions& options, KeyframeId newest, std::set<LandmarkId>* probation,
              Map* map) {
  for (auto it = probation->begin(); it != probation->end();) {
    const L* landmark = map->Find<L>(*it);
    const ProbationState state =
        landmark == nullptr ? ProbationState::kPassed : Evaluate(options, newest, *landmark);
    if (state == ProbationState::kFailed) map->Remove<L>(*it);
    it = state == ProbationState::kPending ? std::next(it) : probation->erase(it);
  }
}

// Whether enough other keyframes observe the landmark of a feature as finely.
template <typename L>
bool IsCovered(const KeyframeIndex& keyframes, const Keyframe& keyframe, const L& landmark,
               const typename L::Feature& feature) {
  int observers = 0;
  for (const Observation& observation : landmark.observations) {
    if (observation.keyframe == keyframe.id) continue;
    const Frame& other = *keyframes.Find(observation.keyframe)->frame;
    if (!L::IsAsFine(FeaturesOf<L>(other)[observation.feature], feature)) continue;
    if (++observers >= kRedundantObservers) return true;
  }
  return false;
}

int NumLandmarks(const std::vector<LandmarkId>& slots) {
  return static_cast<int>(slots.size() - std::count(slots.begin(), slots.end(), kNoId));
}

KeyframeIndex IndexAll(const Map& map) {
  KeyframeIndex index(map);
  for (const auto& [id, keyframe] : map.keyframes()) index.Add(keyframe);
  return index;
}

// Stops at the first landmarks that prove the keyframe not redundant, as for most keyframes.
bool IsRedundant(const CullingOptions& options, const Map& map, const KeyframeIndex& keyframes,
                 const Keyframe& keyframe) {
  int num_landmarks = 0;
  ForEachLandmarkKind([&](auto kind) {
    num_landmarks += NumLandmarks(SlotsOf<typename decltype(kind)::Landmark>(keyframe));
  });
  const double allowed = (1.0 - options.redundant_ratio) * num_landmarks;
  int num_uncovered = 0;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const std::vector<LandmarkId>& slots = SlotsOf<L>(keyframe);
    for (size_t i = 0; i < slots.size() && num_uncovered < allowed; ++i) {
      if (slots[i] == kNoId) continue;
      num_uncovered += !IsCovered(keyframes, keyframe, *map.Find<L>(slots[i]),
                                  FeaturesOf<L>(*keyframe.frame)[i]);
    }
  });
  return num_uncovered < allowed;
}

}  // namespace

void CreateLandmarks(KeyframeId id, Probation* probation, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);  // a copy: adding landmarks changes it
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    CreateKind<L>(keyframe, &probation->Of<L>(), map);
  });
}

void CullLandmarks(const CullingOptions& options, KeyframeId newest, Probation* probation,
                   Map* map) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    CullKind<L>(options, newest, &probation->Of<L>(), map);
  });
}

int CullKeyframes(const CullingOptions& options, KeyframeId newest, Map* map) {
  const KeyframeId first = map->keyframes().front().first;
  const auto* before = map->keyframes().FindUpTo(newest - 1);
  const KeyframeId predecessor = before != nullptr ? before->first : kNoId;
  int num_removed = 0;
  KeyframeIndex keyframes = IndexAll(*map);
  for (const Map::Covisible& covisible : map->FindCovisible(newest)) {
    const KeyframeId id = covisible.keyframe;
    // The predecessor is kept: frames are tracked against it and its landmarks are on probation.
    if (id == first || id > newest || id == predecessor) continue;
    if (!IsRedundant(options, *map, keyframes, *keyframes.Find(id))) continue;
    const std::vector<Map::Covisible> neighbours = map->FindCovisible(id);
    map->RemoveKeyframe(id, neighbours.front().keyframe);
    keyframes = IndexAll(*map);
    ++num_removed;
  }
  return num_removed;
}

}  // namespace msc_vo
