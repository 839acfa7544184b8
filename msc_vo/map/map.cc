// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

// Position of the observation by `keyframe`, or where it is to be inserted.
template <typename Observations>
auto LowerBound(Observations* observations, KeyframeId keyframe) {
  return std::lower_bound(
      observations->begin(), observations->end(), keyframe,
      [](const Observation& observation, KeyframeId id) { return observation.keyframe < id; });
}

template <typename Table>
std::vector<int64_t> Ids(const Table& table) {
  std::vector<int64_t> ids;
  for (const auto& [id, value] : table) ids.push_back(id);
  return ids;
}

}  // namespace

const Observation* FindObservation(const Landmark& landmark, KeyframeId keyframe) {
  const auto place = LowerBound(&landmark.observations, keyframe);
  return place != landmark.observations.end() && place->keyframe == keyframe ? &*place : nullptr;
}

Map Map::Share() {
  Map map;
  map.keyframes_ = keyframes_.Share();
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    map.Table<L>() = Table<L>().Share();
  });
  map.relative_poses_ = relative_poses_.Share();
  map.steps_ = steps_.Share();
  map.next_keyframe_ = next_keyframe_;
  map.next_landmark_ = next_landmark_;
  map.session_begin_ = session_begin_;
  return map;
}

Map Map::Next() const {
  Map map;
  map.next_keyframe_ = next_keyframe_;
  map.next_landmark_ = next_landmark_;
  map.session_begin_ = session_begin_;
  return map;
}

void Map::ContinueIds(KeyframeId next_keyframe, LandmarkId next_landmark) {
  next_keyframe_ = std::max(next_keyframe_, next_keyframe);
  next_landmark_ = std::max(next_landmark_, next_landmark);
}

void Map::Merge(const Map& other) {
  keyframes_.Merge(other.keyframes_);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    Table<L>().Merge(other.landmarks<L>());
  });
  relative_poses_.Merge(other.relative_poses_);
  steps_.Merge(other.steps_);
  next_keyframe_ = std::max(next_keyframe_, other.next_keyframe_);
  next_landmark_ = std::max(next_landmark_, other.next_landmark_);
  session_begin_ = std::max(session_begin_, other.session_begin_);
}

void Map::Transform(const Rigid3& new_from_old_world) {
  const Rigid3 old_from_new_world = new_from_old_world.Inverse();
  for (const int64_t id : Ids(keyframes_)) {
    Keyframe& keyframe = *keyframes_.FindToChange(id);
    keyframe.cam_from_world = keyframe.cam_from_world * old_from_new_world;
  }
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const int64_t id : Ids(Table<L>()))
      Table<L>().FindToChange(id)->Transform(new_from_old_world);
  });
}

const Keyframe* Map::FindKeyframe(KeyframeId id) const { return keyframes_.Find(id); }

KeyframeId Map::AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& cam_from_world,
                            KeyframeId id) {
  if (id == kNoId) id = next_keyframe_;
  if (id < next_keyframe_) {
    throw std::invalid_argument("map: keyframe " + std::to_string(id) + " is not newer than " +
                                std::to_string(next_keyframe_ - 1));
  }
  next_keyframe_ = id + 1;
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.cam_from_world = cam_from_world;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    keyframe.landmarks.Of<L>().assign(FeaturesOf<L>(*frame).size(), kNoId);
  });
  keyframe.frame = std::move(frame);
  keyframes_.Append(id, std::move(keyframe));
  relative_poses_.Append(id, {});
  steps_.Append(id, PoseCovariance::Zero());
  return id;
}

void Map::RemoveKeyframe(KeyframeId id, KeyframeId successor) {
  const Keyframe keyframe = *keyframes_.Find(id);
  *relative_poses_.FindToChange(id) = {
      successor, keyframe.cam_from_world * keyframes_.Find(successor)->cam_from_world.Inverse()};
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const LandmarkId landmark : SlotsOf<L>(keyframe)) {
      if (landmark != kNoId) RemoveObservation<L>(landmark, id);
    }
  });
  keyframes_.Erase(id);
}

void Map::InsertObservation(const Observation& observation, Landmark* landmark) {
  std::vector<Observation>& observations = landmark->observations;
  observations.insert(LowerBound(&observations, observation.keyframe), observation);
}

void Map::EraseObservation(KeyframeId keyframe, Landmark* landmark) {
  landmark->observations.erase(LowerBound(&landmark->observations, keyframe));
}

Descriptor Map::CentralDescriptor(const std::vector<Descriptor>& descriptors) {
  std::vector<int> totals(descriptors.size(), 0);
  for (size_t i = 0; i < descriptors.size(); ++i) {
    for (size_t j = i + 1; j < descriptors.size(); ++j) {
      const int distance = HammingDistance(descriptors[i], descriptors[j]);
      totals[i] += distance;
      totals[j] += distance;
    }
  }
  return descriptors[std::min_element(totals.begin(), totals.end()) - totals.begin()];
}

bool Map::KnowsKeyframe(KeyframeId id) const { return relative_poses_.Find(id) != nullptr; }

std::vector<KeyframeId> Map::KnownKeyframes() const { return Ids(relative_poses_); }

Rigid3 Map::CamFromWorld(KeyframeId id) const {
  // The stored pose to the last bit: a product would normalise its rotation again.
  if (const Keyframe* keyframe = keyframes_.Find(id)) return keyframe->cam_from_world;
  Rigid3 cam_from_successor;
  for (const RelativePose* relative = relative_poses_.Find(id); relative->successor != kNoId;
       relative = relative_poses_.Find(id)) {
    cam_from_successor = cam_from_successor * relative->cam_from_successor;
    id = relative->successor;
  }
  return cam_from_successor * keyframes_.Find(id)->cam_from_world;
}

void Map::SetFrame(KeyframeId keyframe, std::shared_ptr<const Frame> frame) {
  keyframes_.FindToChange(keyframe)->frame = std::move(frame);
}

void Map::SetPose(KeyframeId keyframe, const Rigid3& cam_from_world) {
  keyframes_.FindToChange(keyframe)->cam_from_world = cam_from_world;
}

void Map::SetStepCovariance(KeyframeId keyframe, const PoseCovariance& covariance) {
  *steps_.FindToChange(keyframe) = covariance;
}

const PoseCovariance* Map::StepCovariance(KeyframeId keyframe) const {
  return steps_.Find(keyframe);
}

std::vector<Map::Covisible> Map::FindCovisible(KeyframeId keyframe) const {
  const Keyframe& center = *keyframes_.Find(keyframe);
  ObserverCount observers(*this);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const LandmarkId id : SlotsOf<L>(center)) {
      if (id != kNoId) observers.Add(*Find<L>(id));
    }
  });
  std::vector<Covisible> covisible = observers.Ranked();
  EraseIf(&covisible, [&](const Covisible& other) { return other.keyframe == keyframe; });
  return covisible;
}

}  // namespace msc_vo
