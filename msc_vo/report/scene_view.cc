// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/scene_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/report/svg_plot.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

const char kSceneDescription[] = "Map lines and trajectory in perspective";

namespace {

constexpr SvgPlot::Size kSceneSize{1200, 720};
constexpr SvgPlot::Margins kSceneMargins{16.0, 16.0, 12.0, 34.0};
constexpr double kKeyframeRadius = 3.0;
constexpr double kElevation = DegreesToRadians(33.0);  // of the viewpoint above the scene
// Turned away from the cameras' mean direction, so that walls are not parallel to the picture.
constexpr double kAzimuth = DegreesToRadians(-20.0);
// In units of the radius of the scene: distance of the viewpoint from its centre, near plane.
constexpr double kDistance = 2.6;
constexpr double kNearPlane = 0.15;
// Lines with wrong depth must not shrink the rest of the picture: it covers the line ends without
// this fraction of the smallest and of the largest coordinates, and all ends close to them.
constexpr double kOutlierRatio = 0.02;
constexpr double kCloseRatio = 0.25;  // of the covered range

struct SceneCamera {
  Eigen::Matrix3d rotation;  // cam_from_world; rows: right, down, viewing direction
  Eigen::Vector3d center;    // in world
  double near_plane = 0.0;

  Eigen::Vector3d InCamera(const Eigen::Vector3d& x_in_world) const {
    return rotation * (x_in_world - center);
  }
  // Image coordinates for a focal length of 1, with y upwards.
  static Eigen::Vector2d Project(const Eigen::Vector3d& x_in_cam) {
    return {x_in_cam.x() / x_in_cam.z(), -x_in_cam.y() / x_in_cam.z()};
  }
  // The projection of the part of the segment in front of the near plane, or nullopt.
  std::optional<LineSegment2> Project(const LineSegment3& segment) const {
    Eigen::Vector3d start = InCamera(segment.start), end = InCamera(segment.end);
    if (!start.allFinite() || !end.allFinite()) return std::nullopt;
    if (start.z() < end.z()) std::swap(start, end);
    if (start.z() <= near_plane) return std::nullopt;
    if (end.z() < near_plane) {
      end = start + (start.z() - near_plane) / (start.z() - end.z()) * (end - start);
    }
    return LineSegment2{Project(start), Project(end)};
  }
};

std::vector<Eigen::Vector3d> Trajectory(const ReportData& data) {
  std::vector<Eigen::Vector3d> positions;
  for (const ReportFrame& frame : data.frames) {
    const Eigen::Vector3d position = frame.world_from_cam.translation();
    if (position.allFinite()) positions.push_back(position);
  }
  return positions;
}

// Centre and radius of the trajectory and of most line ends, in the axes of `view_from_world`.
std::pair<Eigen::Vector3d, double> BoundingSphere(const ReportData& data,
                                                  const Eigen::Matrix3d& view_from_world) {
  Eigen::Vector3d center, half_size;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> trajectory, line_ends;
    for (const Eigen::Vector3d& x : Trajectory(data)) {
      trajectory.push_back(view_from_world.row(axis).dot(x));
    }
    for (const ReportLine& line : data.map.lines) {
      line_ends.push_back(view_from_world.row(axis).dot(line.segment.start));
      line_ends.push_back(view_from_world.row(axis).dot(line.segment.end));
    }
    const PlotRange range = Cover(trajectory, std::move(line_ends), kOutlierRatio);
    center[axis] = 0.5 * (range.min + range.max);
    half_size[axis] = 0.5 * range.Length();
  }
  return {view_from_world.transpose() * center, std::max(half_size.norm(), 1e-3)};
}

// Horizontal component of the viewing direction.
Eigen::Vector3d HorizontalDirection(const ReportData& data,
                                    const Eigen::Matrix3d& view_from_world) {
  const Eigen::Vector3d up = view_from_world.row(2);
  const Eigen::Vector3d optical_axis = MeanDirection(data, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d horizontal = optical_axis - up.dot(optical_axis) * up;
  const Eigen::Vector3d forward =
      horizontal.norm() > 0.2 ? horizontal.normalized() : view_from_world.row(1).transpose();
  return Eigen::AngleAxisd(kAzimuth, up) * forward;
}

SceneCamera ChooseCamera(const ReportData& data) {
  const Eigen::Matrix3d view_from_world = ChooseTrajectoryView(data).view_from_world;
  const Eigen::Vector3d up = view_from_world.row(2);
  const Eigen::Vector3d direction =
      std::cos(kElevation) * HorizontalDirection(data, view_from_world) - std::sin(kElevation) * up;
  const Eigen::Vector3d right = direction.cross(up).normalized();
  const auto [center, radius] = BoundingSphere(data, view_from_world);
  SceneCamera camera;
  camera.rotation << right.transpose(), direction.cross(right).transpose(), direction.transpose();
  camera.center = center - kDistance * radius * direction;
  camera.near_plane = kNearPlane * radius;
  return camera;
}

struct SceneDrawing {
  std::vector<LineSegment2> lines[4];  // without axis, along axis 0, 1, 2
  std::vector<Eigen::Vector2d> trajectory, keyframes;
};

SceneDrawing Project(const ReportData& data, const SceneCamera& camera) {
  SceneDrawing drawing;
  for (const ReportLine& line : data.map.lines) {
    const std::optional<LineSegment2> segment = camera.Project(line.segment);
    if (segment) drawing.lines[std::clamp(line.axis, -1, 2) + 1].push_back(*segment);
  }
  for (const ReportFrame& frame : data.frames) {
    const Eigen::Vector3d x = camera.InCamera(frame.world_from_cam.translation());
    if (!(x.z() > camera.near_plane)) continue;
    drawing.trajectory.push_back(SceneCamera::Project(x));
    if (frame.is_keyframe) drawing.keyframes.push_back(drawing.trajectory.back());
  }
  return drawing;
}

PlotRange CoordinateRange(const SceneDrawing& drawing, int axis) {
  std::vector<double> trajectory, line_ends;
  for (const Eigen::Vector2d& p : drawing.trajectory) trajectory.push_back(p[axis]);
  for (const auto& lines : drawing.lines) {
    for (const LineSegment2& line : lines) {
      line_ends.insert(line_ends.end(), {line.start[axis], line.end[axis]});
    }
  }
  PlotRange range = Cover(trajectory, line_ends, kOutlierRatio);
  const double close = kCloseRatio * range.Length();
  const PlotRange bounds{range.min - close, range.max + close};
  for (const double end : line_ends) {
    if (end > bounds.min && end < bounds.max) Include(end, &range);
  }
  const double margin = 0.02 * range.Length();
  return {range.min - margin, range.max + margin};
}

std::string SceneLineClass(int axis) {
  return axis < 0 ? "scene-line axis-none" : "scene-line axis-" + std::to_string(axis);
}

std::vector<PlotLegendEntry> SceneLegend(const SceneDrawing& drawing) {
  std::vector<PlotLegendEntry> legend;
  for (const int axis : {0, 1, 2, -1}) {
    if (drawing.lines[axis + 1].empty()) continue;
    legend.push_back({SceneLineClass(axis),
                      axis < 0 ? "lines without axis"
                               : "lines along Manhattan axis " + std::to_string(axis + 1)});
  }
  legend.push_back({"scene-path", "trajectory with keyframes"});
  return legend;
}

}  // namespace

std::string DrawScene(const ReportData& data) {
  const SceneDrawing drawing = Project(data, ChooseCamera(data));
  SvgPlot plot = SvgPlot::WithEqualAxes(kSceneSize, CoordinateRange(drawing, 0),
                                        CoordinateRange(drawing, 1), kSceneMargins);
  for (int axis = -1; axis < 3; ++axis) {
    plot.AddSegments(drawing.lines[axis + 1], SceneLineClass(axis));
  }
  plot.AddPath(drawing.trajectory, "scene-path");
  plot.AddDots(drawing.keyframes, kKeyframeRadius, "scene-keyframe");
  plot.AddLegend(SceneLegend(drawing));
  return plot.ToString(kSceneDescription);
}

}  // namespace msc_vo
