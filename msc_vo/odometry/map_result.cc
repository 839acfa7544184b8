// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/map_result.h"

#include <map>

namespace msc_vo {

namespace {

MapAxes MakeAxes(const SceneAxes& scene) {
  const AxesEstimator& axes = scene.estimator();
  return {axes.state(), axes.num_refinements(), axes.world_from_axes(), axes.sigma(),
          scene.deviation().scale()};
}

}  // namespace

void AddMap(const Mapper& mapper, KeyframeId first_keyframe, OdometryResult* result) {
  const Map* map = mapper.atlas().FindMapOf(first_keyframe);
  if (map == nullptr) return;
  const SceneAxes& axes = mapper.AxesOf(*map);
  for (const auto& [id, keyframe] : map->keyframes()) {
    result->keyframes.push_back({keyframe.frame->timestamp, keyframe.cam_from_world.Inverse()});
  }
  for (const auto& [id, point] : map->points()) {
    result->points.push_back({point.position, static_cast<int>(point.observations.size())});
  }
  const std::map<LandmarkId, LineSegment3> refined = mapper.RefinedLines(*map);
  for (const auto& [id, line] : map->lines()) {
    const auto found = refined.find(id);
    const LineSegment3& segment = found != refined.end() ? found->second : line.segment;
    result->lines.push_back({segment, static_cast<int>(line.observations.size()),
                             mapper.last_window_lines().count(id) > 0, axes.AxisOf(line),
                             line.viewing_direction});
  }
  result->axes = MakeAxes(axes);
}

}  // namespace msc_vo
