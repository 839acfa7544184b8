// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/tracked_features.h"

#include <optional>
#include <utility>

#include "msc_vo/structure/scene_axes.h"

namespace msc_vo {

namespace {

std::optional<int> AxisIn(const std::optional<AxesEstimate>& axes, const LineLandmark& line) {
  if (!axes) return std::nullopt;
  return AxisOfLine(*axes, line);
}

LineColor ColorOf(const LineFeature& feature, const LineLandmark* landmark,
                  const std::optional<AxesEstimate>& axes) {
  if (!feature.depth) return LineColor::kWithoutDepth;
  const std::optional<int> axis = landmark == nullptr ? std::nullopt : AxisIn(axes, *landmark);
  return axis ? static_cast<LineColor>(*axis) : LineColor::kWithoutAxis;
}

}  // namespace

ViewedFeatures TrackedFeatures(const TrackedImage& tracked, const LensDistortion& distortion) {
  const Frame& frame = tracked.features;
  const auto recorded = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector2f {
    if (distortion.IsZero()) return pixel.cast<float>();
    return distortion.Distort(frame.camera, pixel).cast<float>();
  };
  ViewedFeatures features;
  for (const PointMatch& match : tracked.tracked.matches.points) {
    const PointFeature& point = frame.points[match.feature];
    features.points.push_back({recorded(point.pixel), point.HasDepth()});
  }
  for (const LineMatch& match : tracked.tracked.matches.lines) {
    const LineFeature& line = frame.lines[match.feature];
    features.lines.push_back(
        {recorded(line.segment.start), recorded(line.segment.end),
         ColorOf(line, tracked.map.map.Find<LineLandmark>(match.id), tracked.map.axes)});
  }
  return features;
}

ViewedFeatures ObservedFeatures(const Keyframe& keyframe, const Map& map,
                                const std::optional<AxesEstimate>& axes) {
  const Frame& frame = *keyframe.frame;
  const LensDistortion lens = frame.intrinsics ? frame.intrinsics->distortion : LensDistortion();
  const auto recorded = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector2f {
    return lens.Distort(frame.camera, pixel).cast<float>();
  };
  ViewedFeatures features;
  for (size_t i = 0; i < frame.points.size(); ++i) {
    if (SlotsOf<PointLandmark>(keyframe)[i] == kNoId) continue;
    features.points.push_back({recorded(frame.points[i].pixel), frame.points[i].HasDepth()});
  }
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LandmarkId id = SlotsOf<LineLandmark>(keyframe)[i];
    if (id == kNoId) continue;
    const LineFeature& line = frame.lines[i];
    features.lines.push_back({recorded(line.segment.start), recorded(line.segment.end),
                              ColorOf(line, map.Find<LineLandmark>(id), axes)});
  }
  return features;
}

ReportMap ViewedMap(const MapSnapshot& snapshot) {
  ReportMap map;
  for (const auto& [id, line] : snapshot.map.lines()) {
    map.lines.push_back({line.segment, AxisIn(snapshot.axes, line).value_or(-1)});
  }
  for (const auto& [id, point] : snapshot.map.points()) map.points.push_back(point.position);
  for (const PlaneLandmark& landmark : snapshot.planes.planes) {
    const std::optional<int> axis =
        snapshot.axes ? AxisOfPlane(*snapshot.axes, landmark.plane) : std::nullopt;
    map.planes.push_back({landmark.extent, axis.value_or(-1)});
  }
  ReportSession earlier;
  for (const auto& [id, keyframe] : snapshot.map.keyframes()) {
    if (!snapshot.map.IsOfEarlierSession(id)) break;  // ids ascend
    earlier.positions.push_back(keyframe.cam_from_world.OriginInSource());
  }
  if (!earlier.positions.empty()) map.sessions.push_back(std::move(earlier));
  if (snapshot.axes) map.world_from_axes = snapshot.axes->world_from_axes;
  return map;
}

}  // namespace msc_vo
