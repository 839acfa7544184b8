// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

// Either the points or the lines of a keyframe; the bookkeeping of observations is the same for
// both.
using Slots = std::vector<LandmarkId> Keyframe::*;

// Position of the observation by `keyframe`, or where it is to be inserted.
template <typename Observations>
auto LowerBound(Observations* observations, KeyframeId keyframe) {
  return std::lower_bound(
      observations->begin(), observations->end(), keyframe,
      [](const Observation& observation, KeyframeId id) { return observation.keyframe < id; });
}

template <typename Table>
bool Observe(Table* landmarks, Map::KeyframeTable* keyframes, Slots slots, LandmarkId id,
             const Observation& observation) {
  const auto* landmark = landmarks->Find(id);
  const Keyframe* keyframe = keyframes->Find(observation.keyframe);
  if (landmark == nullptr || keyframe == nullptr) return false;
  if ((keyframe->*slots)[observation.feature] != kNoId) return false;
  if (FindObservation(*landmark, observation.keyframe) != nullptr) return false;
  (keyframes->FindToChange(observation.keyframe)->*slots)[observation.feature] = id;
  auto* changed = landmarks->FindToChange(id);
  std::vector<Observation>& observations = changed->observations;
  observations.insert(LowerBound(&observations, observation.keyframe), observation);
  changed->descriptor_is_current = false;
  return true;
}

template <typename Table>
void RemoveObservation(Table* landmarks, Map::KeyframeTable* keyframes, Slots slots, LandmarkId id,
                       KeyframeId keyframe) {
  const auto* landmark = landmarks->Find(id);
  if (landmark == nullptr) return;
  const Observation* observation = FindObservation(*landmark, keyframe);
  if (observation == nullptr) return;
  (keyframes->FindToChange(keyframe)->*slots)[observation->feature] = kNoId;
  if (landmark->observations.size() == 1) {
    landmarks->Erase(id);
    return;
  }
  auto* changed = landmarks->FindToChange(id);
  changed->observations.erase(LowerBound(&changed->observations, keyframe));
  changed->descriptor_is_current = false;
}

template <typename Table>
void Remove(Table* landmarks, Map::KeyframeTable* keyframes, Slots slots, LandmarkId id) {
  const auto* landmark = landmarks->Find(id);
  if (landmark == nullptr) return;
  for (const Observation& observation : landmark->observations) {
    (keyframes->FindToChange(observation.keyframe)->*slots)[observation.feature] = kNoId;
  }
  landmarks->Erase(id);
}

template <typename Table>
void MergeLandmarks(Table* landmarks, Map::KeyframeTable* keyframes, Slots slots, LandmarkId from,
                    LandmarkId into) {
  const auto source = *landmarks->Find(from);
  Remove(landmarks, keyframes, slots, from);
  for (const Observation& observation : source.observations) {
    Observe(landmarks, keyframes, slots, into, observation);
  }
  auto* target = landmarks->FindToChange(into);
  target->num_visible += source.num_visible;
  target->num_found += source.num_found;
}

template <typename Table>
void CountTracking(LandmarkId id, int num_visible, int num_found, Table* landmarks) {
  auto* landmark = landmarks->FindToChange(id);
  if (landmark == nullptr) return;
  landmark->num_visible += num_visible;
  landmark->num_found += num_found;
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
template <typename Feature>
void RefreshDescriptor(const Map::KeyframeTable& keyframes, std::vector<Feature> Frame::*features,
                       Landmark* landmark) {
  if (landmark->descriptor_is_current) return;
  std::vector<Descriptor> descriptors;
  descriptors.reserve(landmark->observations.size());
  for (const Observation& observation : landmark->observations) {
    const Frame& frame = *keyframes.Find(observation.keyframe)->frame;
    descriptors.push_back((frame.*features)[observation.feature].descriptor);
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
  for (const int64_t id : Ids(points_)) {
    PointLandmark& point = *points_.FindToChange(id);
    point.position = new_from_old_world * point.position;
    point.viewing_direction = new_from_old_world.rotation() * point.viewing_direction;
  }
  for (const int64_t id : Ids(lines_)) {
    LineLandmark& line = *lines_.FindToChange(id);
    line.segment = new_from_old_world * line.segment;
    line.viewing_direction = new_from_old_world.rotation() * line.viewing_direction;
  }
}

const Keyframe* Map::FindKeyframe(KeyframeId id) const { return keyframes_.Find(id); }
const PointLandmark* Map::FindPoint(LandmarkId id) const { return points_.Find(id); }
const LineLandmark* Map::FindLine(LandmarkId id) const { return lines_.Find(id); }

KeyframeId Map::AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& cam_from_world) {
  Keyframe keyframe;
  keyframe.id = next_keyframe_++;
  keyframe.cam_from_world = cam_from_world;
  keyframe.points.assign(frame->points.size(), kNoId);
  keyframe.lines.assign(frame->lines.size(), kNoId);
  keyframe.frame = std::move(frame);
  const KeyframeId id = keyframe.id;
  keyframes_.Append(id, std::move(keyframe));
  relative_poses_.Append(id, {});
  return id;
}

LandmarkId Map::AddPoint(KeyframeId keyframe, int feature, const Eigen::Vector3d& position) {
  const LandmarkId id = next_landmark_++;
  PointLandmark point;
  point.id = id;
  point.first_keyframe = keyframe;
  point.position = position;
  points_.Append(id, std::move(point));
  ObservePoint(id, keyframe, feature);
  RefreshPoint(id);
  return id;
}

LandmarkId Map::AddLine(KeyframeId keyframe, int feature, const LineSegment3& segment) {
  const LandmarkId id = next_landmark_++;
  LineLandmark line;
  line.id = id;
  line.first_keyframe = keyframe;
  line.segment = segment;
  lines_.Append(id, std::move(line));
  ObserveLine(id, keyframe, feature);
  RefreshLine(id);
  return id;
}

bool Map::ObservePoint(LandmarkId point, KeyframeId keyframe, int feature) {
  return Observe(&points_, &keyframes_, &Keyframe::points, point, {keyframe, feature});
}
bool Map::ObserveLine(LandmarkId line, KeyframeId keyframe, int feature) {
  return Observe(&lines_, &keyframes_, &Keyframe::lines, line, {keyframe, feature});
}
void Map::RemovePointObservation(LandmarkId point, KeyframeId keyframe) {
  RemoveObservation(&points_, &keyframes_, &Keyframe::points, point, keyframe);
}
void Map::RemoveLineObservation(LandmarkId line, KeyframeId keyframe) {
  RemoveObservation(&lines_, &keyframes_, &Keyframe::lines, line, keyframe);
}
void Map::RemovePoint(LandmarkId point) { Remove(&points_, &keyframes_, &Keyframe::points, point); }
void Map::RemoveLine(LandmarkId line) { Remove(&lines_, &keyframes_, &Keyframe::lines, line); }
void Map::MergePoints(LandmarkId from, LandmarkId into) {
  MergeLandmarks(&points_, &keyframes_, &Keyframe::points, from, into);
}
void Map::MergeLines(LandmarkId from, LandmarkId into) {
  MergeLandmarks(&lines_, &keyframes_, &Keyframe::lines, from, into);
}

void Map::RemoveKeyframe(KeyframeId id, KeyframeId successor) {
  const Keyframe keyframe = *keyframes_.Find(id);
  *relative_poses_.FindToChange(id) = {
      successor, keyframe.cam_from_world * keyframes_.Find(successor)->cam_from_world.Inverse()};
  for (const LandmarkId point : keyframe.points) {
    if (point != kNoId) RemovePointObservation(point, id);
  }
  for (const LandmarkId line : keyframe.lines) {
    if (line != kNoId) RemoveLineObservation(line, id);
  }
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
void Map::SetPoint(LandmarkId point, const Eigen::Vector3d& position) {
  points_.FindToChange(point)->position = position;
}
void Map::SetLine(LandmarkId line, const LineSegment3& segment) {
  lines_.FindToChange(line)->segment = segment;
}
void Map::SetPointNoise(LandmarkId point, double noise) {
  points_.FindToChange(point)->noise = noise;
}
void Map::SetLineNoise(LandmarkId line, double noise, double depth_offset) {
  LineLandmark* const landmark = lines_.FindToChange(line);
  landmark->noise = noise;
  landmark->depth_offset = depth_offset;
}

void Map::CountPointTracking(LandmarkId point, int num_visible, int num_found) {
  CountTracking(point, num_visible, num_found, &points_);
}
void Map::CountLineTracking(LandmarkId line, int num_visible, int num_found) {
  CountTracking(line, num_visible, num_found, &lines_);
}

void Map::RefreshPoint(LandmarkId id) {
  PointLandmark& point = *points_.FindToChange(id);
  RefreshDescriptor(keyframes_, &Frame::points, &point);
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  double log_reference = 0.0;
  for (const Observation& observation : point.observations) {
    const Keyframe& keyframe = *keyframes_.Find(observation.keyframe);
    const PointFeature& feature = keyframe.frame->points[observation.feature];
    const Eigen::Vector3d ray = point.position - keyframe.cam_from_world.OriginInSource();
    directions += ray.normalized();
    log_reference += std::log(std::max(ray.norm(), 1e-6)) + feature.level * std::log(kPyramidScale);
  }
  point.viewing_direction = directions.normalized();
  point.reference_distance = std::exp(log_reference / point.observations.size());
}

void Map::RefreshLine(LandmarkId id) {
  LineLandmark& line = *lines_.FindToChange(id);
  RefreshDescriptor(keyframes_, &Frame::lines, &line);
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  line.direction_sigma = kPi;
  for (const Observation& observation : line.observations) {
    const Keyframe& keyframe = *keyframes_.Find(observation.keyframe);
    const LineFeature& feature = keyframe.frame->lines[observation.feature];
    if (feature.depth) {
      line.direction_sigma =
          std::min(line.direction_sigma,
                   DirectionSigma(keyframe.frame->camera, feature.segment, *feature.depth));
    }
    directions += (line.segment.Midpoint() - keyframe.cam_from_world.OriginInSource()).normalized();
  }
  line.viewing_direction = directions.normalized();
}

std::vector<Map::Covisible> Map::FindCovisible(KeyframeId keyframe) const {
  const Keyframe& center = *keyframes_.Find(keyframe);
  ObserverCount observers(*this);
  for (const LandmarkId id : center.points) {
    if (id != kNoId) observers.Add(*points_.Find(id));
  }
  for (const LandmarkId id : center.lines) {
    if (id != kNoId) observers.Add(*lines_.Find(id));
  }
  std::vector<Covisible> covisible = observers.Ranked();
  covisible.erase(
      std::remove_if(covisible.begin(), covisible.end(),
                     [&](const Covisible& other) { return other.keyframe == keyframe; }),
      covisible.end());
  return covisible;
}

}  // namespace msc_vo
