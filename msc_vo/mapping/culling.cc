// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/culling.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "msc_vo/map/keyframe_index.h"

namespace msc_vo {

namespace {

enum class ProbationState { kPending, kPassed, kFailed };

ProbationState Evaluate(const CullingOptions& options, KeyframeId newest,
                        const Landmark& landmark) {
  if (landmark.num_found < options.min_found_ratio * landmark.num_visible)
    return ProbationState::kFailed;
  if (newest - landmark.first_keyframe < options.probation_keyframes)
    return ProbationState::kPending;
  const int num_observations = static_cast<int>(landmark.observations.size());
  return num_observations >= options.min_observations ? ProbationState::kPassed
                                                      : ProbationState::kFailed;
}

template <typename Find, typename Remove>
void CullKind(const CullingOptions& options, KeyframeId newest, const Find& find,
              const Remove& remove, std::set<LandmarkId>* probation) {
  for (auto it = probation->begin(); it != probation->end();) {
    const Landmark* landmark = find(*it);
    const ProbationState state =
        landmark == nullptr ? ProbationState::kPassed : Evaluate(options, newest, *landmark);
    if (state == ProbationState::kFailed) remove(*it);
    it = state == ProbationState::kPending ? std::next(it) : probation->erase(it);
  }
}

// Whether enough other keyframes observe the landmark with an observation that is_as_fine accepts.
template <typename IsAsFine>
bool IsCovered(const CullingOptions& options, KeyframeId keyframe, const Landmark& landmark,
               const IsAsFine& is_as_fine) {
  int observers = 0;
  for (const Observation& observation : landmark.observations) {
    if (observation.keyframe == keyframe || !is_as_fine(observation)) continue;
    if (++observers >= options.redundant_observers) return true;
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
  const int num_landmarks = NumLandmarks(keyframe.points) + NumLandmarks(keyframe.lines);
  const double allowed = (1.0 - options.redundant_ratio) * num_landmarks;
  int num_uncovered = 0;
  for (size_t i = 0; i < keyframe.points.size() && num_uncovered < allowed; ++i) {
    if (keyframe.points[i] == kNoId) continue;
    const int level = keyframe.frame->points[i].level;
    const PointLandmark& point = *map.FindPoint(keyframe.points[i]);
    num_uncovered += !IsCovered(options, keyframe.id, point, [&](const Observation& observation) {
      const Keyframe& other = *keyframes.Find(observation.keyframe);
      return other.frame->points[observation.feature].level <= level + 1;
    });
  }
  for (size_t i = 0; i < keyframe.lines.size() && num_uncovered < allowed; ++i) {
    if (keyframe.lines[i] == kNoId) continue;
    const LineLandmark& line = *map.FindLine(keyframe.lines[i]);
    num_uncovered +=
        !IsCovered(options, keyframe.id, line, [](const Observation&) { return true; });
  }
  return num_uncovered < allowed;
}

}  // namespace

bool CullingOptions::IsValid(std::string* error) const {
  if (probation_keyframes < 1 || min_observations < 1 || redundant_observers < 1) {
    *error = "culling: probation_keyframes, min_observations and redundant_observers must be >= 1";
  } else if (!(min_found_ratio >= 0.0 && min_found_ratio <= 1.0)) {
    *error = "culling: min_found_ratio must be in [0, 1]";
  } else if (!(redundant_ratio > 0.0 && redundant_ratio <= 1.0)) {
    *error = "culling: redundant_ratio must be in (0, 1]";
  } else {
    return true;
  }
  return false;
}

void CullLandmarks(const CullingOptions& options, KeyframeId newest, Probation* probation,
                   Map* map) {
  CullKind(
      options, newest, [&](LandmarkId id) { return map->FindPoint(id); },
      [&](LandmarkId id) { map->RemovePoint(id); }, &probation->points);
  CullKind(
      options, newest, [&](LandmarkId id) { return map->FindLine(id); },
      [&](LandmarkId id) { map->RemoveLine(id); }, &probation->lines);
}

int CullKeyframes(const CullingOptions& options, KeyframeId newest, Map* map) {
  const KeyframeId first = map->keyframes().front().first;
  int num_removed = 0;
  KeyframeIndex keyframes = IndexAll(*map);
  for (const Map::Covisible& covisible : map->FindCovisible(newest)) {
    const KeyframeId id = covisible.keyframe;
    // The predecessor is kept: frames are tracked against it and its landmarks are on probation.
    if (id == first || id + 1 >= newest) continue;
    if (!IsRedundant(options, *map, keyframes, *keyframes.Find(id))) continue;
    const std::vector<Map::Covisible> neighbours = map->FindCovisible(id);
    map->RemoveKeyframe(id, neighbours.front().keyframe);
    keyframes = IndexAll(*map);
    ++num_removed;
  }
  return num_removed;
}

}  // namespace msc_vo
