// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

// The points or the lines of a keyframe: the logic of observations is the same for both.
using Slots = std::vector<LandmarkId> Keyframe::*;

template <typename L>
const L* Find(const std::map<int64_t, L>& table, int64_t id) {
  const auto it = table.find(id);
  return it == table.end() ? nullptr : &it->second;
}

std::vector<Observation>::iterator LowerBound(Landmark* landmark, KeyframeId keyframe) {
  return std::lower_bound(
      landmark->observations.begin(), landmark->observations.end(), keyframe,
      [](const Observation& observation, KeyframeId id) { return observation.keyframe < id; });
}

template <typename L>
bool Observe(std::map<LandmarkId, L>* landmarks, std::map<KeyframeId, Keyframe>* keyframes,
             Slots slots, LandmarkId id, const Observation& observation) {
  const auto landmark = landmarks->find(id);
  const auto keyframe = keyframes->find(observation.keyframe);
  if (landmark == landmarks->end() || keyframe == keyframes->end()) return false;
  LandmarkId& slot = (keyframe->second.*slots)[observation.feature];
  const auto place = LowerBound(&landmark->second, observation.keyframe);
  const bool seen_already =
      place != landmark->second.observations.end() && place->keyframe == observation.keyframe;
  if (slot != kNoId || seen_already) return false;
  slot = id;
  landmark->second.observations.insert(place, observation);
  return true;
}

template <typename L>
void Forget(std::map<LandmarkId, L>* landmarks, std::map<KeyframeId, Keyframe>* keyframes,
            Slots slots, LandmarkId id, KeyframeId keyframe) {
  const auto landmark = landmarks->find(id);
  if (landmark == landmarks->end()) return;
  std::vector<Observation>& observations = landmark->second.observations;
  const auto place = LowerBound(&landmark->second, keyframe);
  if (place == observations.end() || place->keyframe != keyframe) return;
  (keyframes->at(keyframe).*slots)[place->feature] = kNoId;
  observations.erase(place);
  if (observations.empty()) landmarks->erase(landmark);
}

template <typename L>
void Remove(std::map<LandmarkId, L>* landmarks, std::map<KeyframeId, Keyframe>* keyframes,
            Slots slots, LandmarkId id) {
  const auto landmark = landmarks->find(id);
  if (landmark == landmarks->end()) return;
  for (const Observation& observation : landmark->second.observations) {
    (keyframes->at(observation.keyframe).*slots)[observation.feature] = kNoId;
  }
  landmarks->erase(landmark);
}

template <typename L>
void Merge(std::map<LandmarkId, L>* landmarks, std::map<KeyframeId, Keyframe>* keyframes,
           Slots slots, LandmarkId from, LandmarkId into) {
  const L source = landmarks->at(from);
  Remove(landmarks, keyframes, slots, from);
  for (const Observation& observation : source.observations) {
    Observe(landmarks, keyframes, slots, into, observation);
  }
  L& target = landmarks->at(into);
  target.num_visible += source.num_visible;
  target.num_found += source.num_found;
}

// The descriptor with the least total distance to all others; the first of equals.
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

}  // namespace

const Keyframe* Map::FindKeyframe(KeyframeId id) const { return Find(keyframes_, id); }
const PointLandmark* Map::FindPoint(LandmarkId id) const { return Find(points_, id); }
const LineLandmark* Map::FindLine(LandmarkId id) const { return Find(lines_, id); }

KeyframeId Map::AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& cam_from_world) {
  Keyframe keyframe;
  keyframe.id = next_keyframe_++;
  keyframe.cam_from_world = cam_from_world;
  keyframe.points.assign(frame->points.size(), kNoId);
  keyframe.lines.assign(frame->lines.size(), kNoId);
  keyframe.frame = std::move(frame);
  const KeyframeId id = keyframe.id;
  keyframes_.emplace(id, std::move(keyframe));
  return id;
}

LandmarkId Map::AddPoint(KeyframeId keyframe, int feature, const Eigen::Vector3d& position) {
  PointLandmark point;
  point.id = next_landmark_++;
  point.first_keyframe = keyframe;
  point.position = position;
  points_.emplace(point.id, point);
  ObservePoint(point.id, keyframe, feature);
  RefreshPoint(point.id);
  return point.id;
}

LandmarkId Map::AddLine(KeyframeId keyframe, int feature, const LineSegment3& segment) {
  LineLandmark line;
  line.id = next_landmark_++;
  line.first_keyframe = keyframe;
  line.segment = segment;
  lines_.emplace(line.id, line);
  ObserveLine(line.id, keyframe, feature);
  RefreshLine(line.id);
  return line.id;
}

bool Map::ObservePoint(LandmarkId point, KeyframeId keyframe, int feature) {
  return Observe(&points_, &keyframes_, &Keyframe::points, point, {keyframe, feature});
}
bool Map::ObserveLine(LandmarkId line, KeyframeId keyframe, int feature) {
  return Observe(&lines_, &keyframes_, &Keyframe::lines, line, {keyframe, feature});
}
void Map::ForgetPoint(LandmarkId point, KeyframeId keyframe) {
  Forget(&points_, &keyframes_, &Keyframe::points, point, keyframe);
}
void Map::ForgetLine(LandmarkId line, KeyframeId keyframe) {
  Forget(&lines_, &keyframes_, &Keyframe::lines, line, keyframe);
}
void Map::RemovePoint(LandmarkId point) { Remove(&points_, &keyframes_, &Keyframe::points, point); }
void Map::RemoveLine(LandmarkId line) { Remove(&lines_, &keyframes_, &Keyframe::lines, line); }
void Map::MergePoints(LandmarkId from, LandmarkId into) {
  Merge(&points_, &keyframes_, &Keyframe::points, from, into);
}
void Map::MergeLines(LandmarkId from, LandmarkId into) {
  Merge(&lines_, &keyframes_, &Keyframe::lines, from, into);
}

void Map::RemoveKeyframe(KeyframeId id, KeyframeId heir) {
  const Keyframe keyframe = keyframes_.at(id);
  removed_[id] = {heir, keyframe.cam_from_world * keyframes_.at(heir).cam_from_world.Inverse()};
  for (const LandmarkId point : keyframe.points) {
    if (point != kNoId) ForgetPoint(point, id);
  }
  for (const LandmarkId line : keyframe.lines) {
    if (line != kNoId) ForgetLine(line, id);
  }
  keyframes_.erase(id);
}

Rigid3 Map::CamFromWorld(KeyframeId id) const {
  // As it stands, to the last bit: a product would normalise its rotation again.
  if (const auto keyframe = keyframes_.find(id); keyframe != keyframes_.end()) {
    return keyframe->second.cam_from_world;
  }
  Rigid3 cam_from_heir;
  for (auto removed = removed_.find(id); removed != removed_.end(); removed = removed_.find(id)) {
    cam_from_heir = cam_from_heir * removed->second.cam_from_heir;
    id = removed->second.heir;
  }
  return cam_from_heir * keyframes_.at(id).cam_from_world;
}

void Map::SetPose(KeyframeId keyframe, const Rigid3& cam_from_world) {
  keyframes_.at(keyframe).cam_from_world = cam_from_world;
}
void Map::SetPoint(LandmarkId point, const Eigen::Vector3d& position) {
  points_.at(point).position = position;
}
void Map::SetLine(LandmarkId line, const LineSegment3& segment) {
  lines_.at(line).segment = segment;
}

void Map::CountTracking(LandmarkId landmark, bool is_line, int num_visible, int num_found) {
  const auto count = [&](auto* landmarks) {
    const auto it = landmarks->find(landmark);
    if (it == landmarks->end()) return;
    it->second.num_visible += num_visible;
    it->second.num_found += num_found;
  };
  is_line ? count(&lines_) : count(&points_);
}

void Map::RefreshPoint(LandmarkId id) {
  PointLandmark& point = points_.at(id);
  std::vector<Descriptor> descriptors;
  descriptors.reserve(point.observations.size());
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  double log_reference = 0.0;
  for (const Observation& observation : point.observations) {
    const Keyframe& keyframe = keyframes_.at(observation.keyframe);
    const PointFeature& feature = keyframe.frame->points[observation.feature];
    const Eigen::Vector3d ray = point.position - keyframe.cam_from_world.OriginInSource();
    descriptors.push_back(feature.descriptor);
    directions += ray.normalized();
    log_reference += std::log(std::max(ray.norm(), 1e-6)) + feature.level * std::log(kPyramidScale);
  }
  point.descriptor = CentralDescriptor(descriptors);
  point.viewing_direction = directions.normalized();
  point.reference_distance = std::exp(log_reference / point.observations.size());
}

void Map::RefreshLine(LandmarkId id) {
  LineLandmark& line = lines_.at(id);
  std::vector<Descriptor> descriptors;
  descriptors.reserve(line.observations.size());
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  line.direction_sigma = kPi;
  for (const Observation& observation : line.observations) {
    const Keyframe& keyframe = keyframes_.at(observation.keyframe);
    const LineFeature& feature = keyframe.frame->lines[observation.feature];
    descriptors.push_back(feature.descriptor);
    if (feature.depth) {
      line.direction_sigma =
          std::min(line.direction_sigma,
                   DirectionSigma(keyframe.frame->camera, feature.segment, *feature.depth));
    }
    directions += (line.segment.Midpoint() - keyframe.cam_from_world.OriginInSource()).normalized();
  }
  line.descriptor = CentralDescriptor(descriptors);
  line.viewing_direction = directions.normalized();
}

std::vector<Map::Covisible> Map::FindCovisible(KeyframeId keyframe) const {
  const Keyframe& center = keyframes_.at(keyframe);
  ObserverCount observers(*this);
  for (const LandmarkId id : center.points) {
    if (id != kNoId) observers.Add(points_.at(id));
  }
  for (const LandmarkId id : center.lines) {
    if (id != kNoId) observers.Add(lines_.at(id));
  }
  std::vector<Covisible> covisible = observers.Ranked();
  covisible.erase(
      std::remove_if(covisible.begin(), covisible.end(),
                     [&](const Covisible& other) { return other.keyframe == keyframe; }),
      covisible.end());
  return covisible;
}

}  // namespace msc_vo
