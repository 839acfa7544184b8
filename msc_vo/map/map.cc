// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "msc_vo/geometry/angles.h"
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

// Returns the descriptor with the smallest total distance to all others; the first one on ties.
Descriptor CentralDescriptor(const std::vector<Descriptor>& descriptors) {
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

// Selects the descriptor again if the observations have changed.
template <typename L>
void RefreshDescriptor(const Map::KeyframeTable& keyframes, L* landmark) {
  if (landmark->descriptor_is_current) return;
  std::vector<Descriptor> descriptors;
  descriptors.reserve(landmark->observations.size());
  for (const Observation& observation : landmark->observations) {
    const Frame& frame = *keyframes.Find(observation.keyframe)->frame;
    descriptors.push_back(FeaturesOf<L>(frame)[observation.feature].descriptor);
  }
  landmark->descriptor = CentralDescriptor(descriptors);
  landmark->descriptor_is_current = true;
}

}  // namespace

const Observation* FindObservation(const Landmark& landmark, KeyframeId keyframe) {
  const auto place = LowerBound(&landmark.observations, keyframe);
  return place != landmark.observations.end() && place->keyframe == keyframe ? &*place : nullptr;
}

Map Map::Share() {
  Map map;
  map.keyframes_ = keyframes_.Share();
  map.points_ = points_.Share();
  map.lines_ = lines_.Share();
  map.relative_poses_ = relative_poses_.Share();
  map.next_keyframe_ = next_keyframe_;
  map.next_landmark_ = next_landmark_;
  return map;
}

Map Map::Next() const {
  Map map;
  map.next_keyframe_ = next_keyframe_;
  map.next_landmark_ = next_landmark_;
  return map;
}

void Map::Merge(const Map& other) {
  keyframes_.Merge(other.keyframes_);
  points_.Merge(other.points_);
  lines_.Merge(other.lines_);
  relative_poses_.Merge(other.relative_poses_);
  next_keyframe_ = std::max(next_keyframe_, other.next_keyframe_);
  next_landmark_ = std::max(next_landmark_, other.next_landmark_);
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
  keyframe.points.assign(frame->points.size(), kNoId);
  keyframe.lines.assign(frame->lines.size(), kNoId);
  keyframe.frame = std::move(frame);
  keyframes_.Append(id, std::move(keyframe));
  relative_poses_.Append(id, {});
  return id;
}

template <typename L>
LandmarkId Map::Add(KeyframeId keyframe, int feature, const typename L::Geometry& geometry) {
  const LandmarkId id = next_landmark_++;
  L landmark;
  landmark.id = id;
  landmark.first_keyframe = keyframe;
  landmark.SetGeometry(geometry);
  Table<L>().Append(id, std::move(landmark));
  Observe<L>(id, keyframe, feature);
  Refresh<L>(id);
  return id;
}

template <typename L>
bool Map::Observe(LandmarkId id, KeyframeId keyframe_id, int feature) {
  const L* landmark = Find<L>(id);
  const Keyframe* keyframe = FindKeyframe(keyframe_id);
  if (landmark == nullptr || keyframe == nullptr) return false;
  if (SlotsOf<L>(*keyframe)[feature] != kNoId) return false;
  if (FindObservation(*landmark, keyframe_id) != nullptr) return false;
  OfKind<L>(*keyframes_.FindToChange(keyframe_id))[feature] = id;
  L* const changed = Table<L>().FindToChange(id);
  std::vector<Observation>& observations = changed->observations;
  observations.insert(LowerBound(&observations, keyframe_id), {keyframe_id, feature});
  changed->descriptor_is_current = false;
  return true;
}

template <typename L>
void Map::RemoveObservation(LandmarkId id, KeyframeId keyframe) {
  const L* landmark = Find<L>(id);
  if (landmark == nullptr) return;
  const Observation* observation = FindObservation(*landmark, keyframe);
  if (observation == nullptr) return;
  OfKind<L>(*keyframes_.FindToChange(keyframe))[observation->feature] = kNoId;
  if (landmark->observations.size() == 1) {
    Table<L>().Erase(id);
    return;
  }
  L* const changed = Table<L>().FindToChange(id);
  changed->observations.erase(LowerBound(&changed->observations, keyframe));
  changed->descriptor_is_current = false;
}

template <typename L>
void Map::Remove(LandmarkId id) {
  const L* landmark = Find<L>(id);
  if (landmark == nullptr) return;
  for (const Observation& observation : landmark->observations) {
    Keyframe* const keyframe = keyframes_.FindToChange(observation.keyframe);
    OfKind<L>(*keyframe)[observation.feature] = kNoId;
  }
  Table<L>().Erase(id);
}

template <typename L>
void Map::MergeLandmarks(LandmarkId from, LandmarkId into) {
  const L source = *Find<L>(from);
  Remove<L>(from);
  for (const Observation& observation : source.observations) {
    Observe<L>(into, observation.keyframe, observation.feature);
  }
  L* const target = Table<L>().FindToChange(into);
  target->num_visible += source.num_visible;
  target->num_found += source.num_found;
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

bool Map::KnowsKeyframe(KeyframeId id) const { return relative_poses_.Find(id) != nullptr; }

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

template <typename L>
void Map::CountTracking(LandmarkId id, int num_visible, int num_found) {
  L* const landmark = Table<L>().FindToChange(id);
  if (landmark == nullptr) return;
  landmark->num_visible += num_visible;
  landmark->num_found += num_found;
}

template <typename L>
void Map::Refresh(LandmarkId id) {
  L* const landmark = Table<L>().FindToChange(id);
  RefreshDescriptor(keyframes_, landmark);
  RefreshViews(landmark);
}

void Map::RefreshViews(PointLandmark* point) const {
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  double log_reference = 0.0;
  for (const Observation& observation : point->observations) {
    const Keyframe& keyframe = *keyframes_.Find(observation.keyframe);
    const PointFeature& feature = keyframe.frame->points[observation.feature];
    const Eigen::Vector3d ray = point->position - keyframe.cam_from_world.OriginInSource();
    directions += ray.normalized();
    log_reference += std::log(std::max(ray.norm(), 1e-6)) + feature.level * std::log(kPyramidScale);
  }
  point->viewing_direction = directions.normalized();
  point->reference_distance = std::exp(log_reference / point->observations.size());
}

void Map::RefreshViews(LineLandmark* line) const {
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  line->direction_sigma = kPi;
  for (const Observation& observation : line->observations) {
    const Keyframe& keyframe = *keyframes_.Find(observation.keyframe);
    const LineFeature& feature = keyframe.frame->lines[observation.feature];
    if (feature.depth) {
      line->direction_sigma =
          std::min(line->direction_sigma,
                   DirectionSigma(keyframe.frame->camera, feature.segment, *feature.depth));
    }
    directions +=
        (line->segment.Midpoint() - keyframe.cam_from_world.OriginInSource()).normalized();
  }
  line->viewing_direction = directions.normalized();
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
  covisible.erase(
      std::remove_if(covisible.begin(), covisible.end(),
                     [&](const Covisible& other) { return other.keyframe == keyframe; }),
      covisible.end());
  return covisible;
}

// The kinds of landmarks (landmark_kinds.h).
template LandmarkId Map::Add<PointLandmark>(KeyframeId, int, const Eigen::Vector3d&);
template bool Map::Observe<PointLandmark>(LandmarkId, KeyframeId, int);
template void Map::RemoveObservation<PointLandmark>(LandmarkId, KeyframeId);
template void Map::Remove<PointLandmark>(LandmarkId);
template void Map::MergeLandmarks<PointLandmark>(LandmarkId, LandmarkId);
template void Map::CountTracking<PointLandmark>(LandmarkId, int, int);
template void Map::Refresh<PointLandmark>(LandmarkId);
template LandmarkId Map::Add<LineLandmark>(KeyframeId, int, const LineSegment3&);
template bool Map::Observe<LineLandmark>(LandmarkId, KeyframeId, int);
template void Map::RemoveObservation<LineLandmark>(LandmarkId, KeyframeId);
template void Map::Remove<LineLandmark>(LandmarkId);
template void Map::MergeLandmarks<LineLandmark>(LandmarkId, LandmarkId);
template void Map::CountTracking<LineLandmark>(LandmarkId, int, int);
template void Map::Refresh<LineLandmark>(LandmarkId);

}  // namespace msc_vo
