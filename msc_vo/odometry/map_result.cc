// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/map_result.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace msc_vo {

namespace {

MapAxes MakeAxes(const SceneAxes& scene) {
  const AxesEstimator& axes = scene.estimator();
  return {axes.state(), axes.num_refinements(), axes.world_from_axes(), axes.sigma(),
          scene.deviation().scale()};
}

// Whether a frame is still a keyframe: its pose may have been discarded (KeepLocalizedPoses()).
bool IsKeyframe(double timestamp, const std::vector<FrameResult>& frames) {
  const auto frame = std::lower_bound(
      frames.begin(), frames.end(), timestamp,
      [](const FrameResult& other, double time) { return other.timestamp < time; });
  return frame != frames.end() && frame->timestamp == timestamp && frame->is_keyframe;
}

// Index of the session that added the keyframe; the sessions are in order of their keyframes.
size_t SessionOf(KeyframeId keyframe, const std::vector<MapSession>& sessions) {
  size_t index = 0;
  while (index + 1 < sessions.size() && sessions[index + 1].first_keyframe <= keyframe) ++index;
  return index;
}

}  // namespace

std::vector<MapPlane> MakeMapPlanes(const PlaneMap& planes, const Map& map,
                                    const std::optional<AxesEstimate>& axes) {
  const std::map<LandmarkId, int> counts = planes.NumObservations();
  std::vector<MapPlane> result;
  for (const PlaneLandmark& landmark : planes.InWorld(map).planes) {
    result.push_back({landmark.plane, landmark.extent, counts.at(landmark.id),
                      axes ? AxisOfPlane(*axes, landmark.plane) : std::nullopt});
  }
  return result;
}

void AddMap(const Mapper& mapper, SubMapId submap_id, OdometryResult* result) {
  const SubMap* submap = mapper.atlas().Find(submap_id);
  if (submap == nullptr) return;
  const Map& map = submap->map;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (map.IsOfEarlierSession(id) || !IsKeyframe(keyframe.frame->timestamp, result->frames)) {
      continue;
    }
    result->keyframes.push_back({keyframe.frame->timestamp, keyframe.cam_from_world.Inverse()});
  }
  for (const auto& [id, point] : map.points()) {
    result->points.push_back({point.position, static_cast<int>(point.observations.size())});
  }
  const std::map<LandmarkId, RefinedLine> refined = mapper.RefinedLines(*submap);
  for (const auto& [id, line] : map.lines()) {
    const auto found = refined.find(id);
    const RefinedLine best = found != refined.end() ? found->second : RefinedLine{line.segment, {}};
    const bool is_active = mapper.last_window_lines().count(id) > 0;
    result->lines.push_back({best.segment, static_cast<int>(line.observations.size()), is_active,
                             best.axis ? best.axis : submap->axes.AxisOf(line),
                             line.viewing_direction});
  }
  result->planes = MakeMapPlanes(submap->planes.Fitted(map), map, submap->axes.Estimate());
  result->axes = MakeAxes(submap->axes);
}

void AddEarlierSessions(const Atlas& atlas, const std::vector<MapSession>& sessions,
                        OdometryResult* result) {
  const int num_worlds = static_cast<int>(result->segments.size());
  for (int world = 0; world < num_worlds && result->segments[world].is_earlier_session; ++world) {
    const SubMap* submap = atlas.Find(world);
    if (submap == nullptr) continue;  // joined with an older one
    std::vector<SessionPath> paths;
    for (const MapSession& session : sessions) paths.push_back({session.name, world, {}});
    for (const auto& [id, keyframe] : submap->map.keyframes()) {
      if (!submap->map.IsOfEarlierSession(id)) continue;
      paths[SessionOf(id, sessions)].world_from_cam.push_back(keyframe.cam_from_world.Inverse());
    }
    for (SessionPath& path : paths) {
      if (!path.world_from_cam.empty()) result->earlier_sessions.push_back(std::move(path));
    }
  }
}

}  // namespace msc_vo
