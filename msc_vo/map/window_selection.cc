// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/window_selection.h"

#include <algorithm>
#include <set>
#include <vector>

#include "msc_vo/map/id_set.h"
#include "msc_vo/map/keyframe_index.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

// Metres; the shortest segment whose direction a sensor of 1 mm resolution can determine.
constexpr double kMinWindowLineLength = 0.01;
// Smallest number of landmarks that a keyframe of the window shares with the current one; fewer
// would link its pose too weakly.
constexpr int kMinShared = 10;

// The landmarks that the window's keyframes observe, by id; counts their observers.
template <typename L>
std::vector<const L*> ObservedLandmarks(const Map& map, const std::set<KeyframeId>& window,
                                        int min_observations, ObserverCount* observers) {
  IdSet ids(map.landmarks<L>());
  for (const KeyframeId keyframe : window) {
    for (const LandmarkId id : SlotsOf<L>(*map.FindKeyframe(keyframe))) {
      if (id != kNoId) ids.Insert(id);
    }
  }
  std::vector<const L*> landmarks;
  ids.VisitAll([&](const L& landmark) {
    if (static_cast<int>(landmark.observations.size()) < min_observations) return;
    landmarks.push_back(&landmark);
    observers->Add(landmark);
  });
  return landmarks;
}

std::set<KeyframeId> SelectKeyframes(const WindowSelectionOptions& options, const Map& map,
                                     KeyframeId keyframe) {
  std::set<KeyframeId> window = {keyframe};
  for (const Map::Covisible& covisible : map.FindCovisible(keyframe)) {
    if (static_cast<int>(window.size()) >= options.max_keyframes) break;
    if (covisible.num_shared >= kMinShared) window.insert(covisible.keyframe);
  }
  return window;
}

int NumShared(const Map& map, KeyframeId a, KeyframeId b) {
  for (const Map::Covisible& covisible : map.FindCovisible(a)) {
    if (covisible.keyframe == b) return covisible.num_shared;
  }
  return 0;
}

// Adds the keyframe before each keyframe of the window in time, if landmarks hardly link the two.
void AddPredecessors(const Map& map, std::set<KeyframeId>* window) {
  for (const KeyframeId id : std::set<KeyframeId>(*window)) {
    const auto* before = map.keyframes().FindUpTo(id - 1);
    if (before == nullptr || window->count(before->first) > 0) continue;
    if (map.IsOfEarlierSession(before->first)) continue;  // no factor of this run links it
    if (NumShared(map, id, before->first) < kMinShared) window->insert(before->first);
  }
}

// The keyframes outside the window that observe most of its landmarks.
std::set<KeyframeId> SelectFixed(const WindowSelectionOptions& options,
                                 const std::set<KeyframeId>& window,
                                 const ObserverCount& observers) {
  std::set<KeyframeId> fixed;
  for (const Map::Covisible& observer : observers.Ranked()) {
    if (static_cast<int>(fixed.size()) >= options.max_fixed_keyframes) break;
    if (window.count(observer.keyframe) == 0) fixed.insert(observer.keyframe);
  }
  return fixed;
}

void AddKeyframes(const Map& map, const std::set<KeyframeId>& window,
                  const std::set<KeyframeId>& fixed, WindowData* data) {
  const KeyframeId first = map.keyframes().front().first;
  for (const KeyframeId id : window) {
    data->keyframes.push_back({id, map.FindKeyframe(id)->cam_from_world, id == first});
  }
  // Without fixed observers the oldest keyframe holds the gauge.
  if (fixed.empty()) data->keyframes.front().fixed = true;
  for (const KeyframeId id : fixed) {
    data->keyframes.push_back({id, map.FindKeyframe(id)->cam_from_world, true});
  }
}

// The number of observations of landmarks by any keyframes.
template <typename L>
size_t NumObservations(const std::vector<const L*>& landmarks) {
  size_t count = 0;
  for (const L* landmark : landmarks) count += landmark->observations.size();
  return count;
}

// Adds the observations of the landmark by the given keyframes.
template <typename L, typename O>
void AddObservations(const KeyframeIndex& keyframes, const L& landmark,
                     std::vector<O>* observations) {
  for (const Observation& observation : landmark.observations) {
    const Keyframe* keyframe = keyframes.Find(observation.keyframe);
    if (keyframe == nullptr) continue;
    observations->push_back(MakeObservation(*keyframe, landmark, observation.feature));
  }
}

void AddLines(const KeyframeIndex& keyframes, const std::vector<const LineLandmark*>& lines,
              WindowData* data) {
  data->lines.reserve(lines.size());
  data->line_observations.reserve(NumObservations(lines));
  for (const LineLandmark* line : lines) {
    data->lines.push_back({line->id, line->segment, false, line->noise, line->depth_offset});
    AddObservations(keyframes, *line, &data->line_observations);
  }
}

// Computes the parameter s of the point of the line a + s (b - a) that is nearest to the ray
// origin + t ray. Returns false if the ray is nearly parallel to the line.
bool IntersectRay(const LineSegment3& line, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& ray, double* s) {
  const Eigen::Vector3d d = line.end - line.start;
  const Eigen::Vector3d w = origin - line.start;
  const double dd = d.squaredNorm();
  const double rr = ray.squaredNorm();
  const double dr = d.dot(ray);
  const double determinant = dd * rr - dr * dr;
  // sin^2 of the angle between ray and line: below 0.1 (18 degrees) one pixel moves the
  // intersection by more than three times its size across the line.
  if (determinant < 0.1 * dd * rr) return false;
  *s = (d.dot(w) * rr - ray.dot(w) * dr) / determinant;
  return true;
}

// Moves a keyframe, and the landmarks that it alone observes with it: they are where they were in
// its camera frame.
void MoveKeyframe(const WindowData::Keyframe& moved, Map* map) {
  const Keyframe before = *map->FindKeyframe(moved.id);
  const Rigid3 motion = moved.cam_from_world.Inverse() * before.cam_from_world;
  map->SetPose(moved.id, moved.cam_from_world);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const LandmarkId id : SlotsOf<L>(before)) {
      const L* landmark = id == kNoId ? nullptr : map->Find<L>(id);
      if (landmark == nullptr || landmark->observations.size() > 1) continue;
      map->SetGeometry<L>(id, motion * landmark->geometry());
      map->Refresh<L>(id);
    }
  });
}

WindowData MakeWindow(const WindowSelectionOptions& options, const Map& map,
                      const std::set<KeyframeId>& window, const PinholeCamera& camera) {
  ObserverCount observers(map);
  const auto points =
      ObservedLandmarks<PointLandmark>(map, window, options.min_observations, &observers);
  const auto lines =
      ObservedLandmarks<LineLandmark>(map, window, options.min_observations, &observers);

  WindowData data;
  data.camera = camera;
  AddKeyframes(map, window, SelectFixed(options, window, observers), &data);
  KeyframeIndex keyframes(map);
  for (const WindowData::Keyframe& selected : data.keyframes) {
    keyframes.Add(*map.FindKeyframe(selected.id));
  }
  data.points.reserve(points.size());
  data.point_observations.reserve(NumObservations(points));
  for (const PointLandmark* point : points) {
    data.points.push_back({point->id, point->position, false, point->noise});
    AddObservations(keyframes, *point, &data.point_observations);
  }
  AddLines(keyframes, lines, &data);
  return data;
}

}  // namespace

WindowData::PointObservation MakeObservation(const Keyframe& keyframe, const PointLandmark& point,
                                             int feature_index) {
  const PointFeature& feature = keyframe.frame->points[feature_index];
  WindowData::PointObservation observation;
  observation.keyframe = keyframe.id;
  observation.point = point.id;
  observation.pixel = feature.pixel;
  observation.sigma = feature.sigma;
  if (point.has_false_depth) return observation;
  observation.inverse_depth = feature.inverse_depth;
  observation.inverse_depth_sigma = feature.inverse_depth_sigma;
  return observation;
}

WindowData::LineObservation MakeObservation(const Keyframe& keyframe, const LineLandmark& line,
                                            int feature_index) {
  const LineFeature& feature = keyframe.frame->lines[feature_index];
  WindowData::LineObservation observation;
  observation.keyframe = keyframe.id;
  observation.line = line.id;
  observation.segment = feature.segment;
  observation.sigma = feature.sigma;
  observation.has_depth = feature.depth.has_value() && !line.has_false_depth;
  if (observation.has_depth) observation.depth = *feature.depth;
  return observation;
}

WindowData SelectWindow(const WindowSelectionOptions& options, const Map& map, KeyframeId keyframe,
                        WindowLinks links) {
  std::set<KeyframeId> window = SelectKeyframes(options, map, keyframe);
  if (links == WindowLinks::kLandmarksAndTime) AddPredecessors(map, &window);
  return MakeWindow(options, map, window, map.FindKeyframe(keyframe)->frame->camera);
}

WindowData SelectLines(const WindowSelectionOptions& options, const Map& map) {
  WindowData data;
  data.camera = map.keyframes().back().second.frame->camera;
  KeyframeIndex keyframes(map);
  for (const auto& [id, keyframe] : map.keyframes()) {
    data.keyframes.push_back({id, keyframe.cam_from_world, true});
    keyframes.Add(keyframe);
  }
  std::vector<const LineLandmark*> lines;
  for (const auto& [id, line] : map.landmarks<LineLandmark>()) {
    if (static_cast<int>(line.observations.size()) >= options.min_observations) {
      lines.push_back(&line);
    }
  }
  AddLines(keyframes, lines, &data);
  return data;
}

WindowData SelectSession(const WindowSelectionOptions& options, const Map& map) {
  std::set<KeyframeId> window;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (!map.IsOfEarlierSession(id)) window.insert(id);
  }
  return MakeWindow(options, map, window, map.keyframes().back().second.frame->camera);
}

LineSegment3 TrimToObservations(const Map& map, const LineLandmark& line,
                                const LineSegment3& segment) {
  double first = 0.0;
  double last = 0.0;
  bool any = false;
  for (const Observation& observation : line.observations) {
    const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
    const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
    const LineSegment2& image = keyframe.frame->lines[observation.feature].segment;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(image.start), Eigen::Vector2d(image.end)}) {
      double s = 0.0;
      const Eigen::Vector3d ray = world_from_cam.rotation() * keyframe.frame->camera.Ray(pixel);
      if (!IntersectRay(segment, world_from_cam.translation(), ray, &s)) continue;
      first = any ? std::min(first, s) : s;
      last = any ? std::max(last, s) : s;
      any = true;
    }
  }
  LineSegment3 cut;
  cut.start = segment.At(first);
  cut.end = segment.At(last);
  return cut.Length() > kMinWindowLineLength ? cut : segment;
}

void WriteBack(const WindowData& window, Map* map) {
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    if (!keyframe.fixed) MoveKeyframe(keyframe, map);
  }
  for (const WindowData::PointObservation& observation : window.point_observations) {
    if (observation.rejected)
      map->RemoveObservation<PointLandmark>(observation.point, observation.keyframe);
  }
  for (const WindowData::LineObservation& observation : window.line_observations) {
    if (observation.rejected)
      map->RemoveObservation<LineLandmark>(observation.line, observation.keyframe);
  }
  for (const WindowData::Point& point : window.points) {
    if (map->Find<PointLandmark>(point.id) == nullptr) continue;
    map->SetGeometry<PointLandmark>(point.id, point.position);
    map->SetNoise<PointLandmark>(point.id, point.noise);
    map->Refresh<PointLandmark>(point.id);
  }
  for (const WindowData::Line& line : window.lines) {
    const LineLandmark* landmark = map->Find<LineLandmark>(line.id);
    if (landmark == nullptr) continue;
    // Wrong matches may contract a line until it has no direction.
    if (!(line.segment.Length() > kMinWindowLineLength)) {
      map->Remove<LineLandmark>(line.id);
      continue;
    }
    map->SetGeometry<LineLandmark>(line.id, TrimToObservations(*map, *landmark, line.segment));
    map->SetNoise<LineLandmark>(line.id, line.noise);
    map->SetDepthOffset(line.id, line.depth_offset);
    map->Refresh<LineLandmark>(line.id);
  }
}

}  // namespace msc_vo
