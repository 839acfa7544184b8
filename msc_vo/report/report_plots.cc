// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_plots.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/report_statistics.h"
#include "msc_vo/report/svg_plot.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {
namespace {

constexpr SvgPlot::Size kTrajectorySize{600, 460};
constexpr double kKeyframeRadius = 2.4;
constexpr double kGapRadius = 2.2;
constexpr double kStartRadius = 5.0;

// Orthographic projection from the world onto the page.
struct Projector {
  Eigen::Matrix<double, 2, 3> page_from_world;

  Eigen::Vector2d operator()(const Eigen::Vector3d& x_in_world) const {
    return page_from_world * x_in_world;
  }
};

Projector MakeProjector(const TrajectoryView& view, TrajectorySide side) {
  Projector projector;
  projector.page_from_world << view.view_from_world.row(0),
      view.view_from_world.row(side == TrajectorySide::kTop ? 1 : 2);
  return projector;
}

struct TrajectoryDrawing {
  using Path = std::vector<Eigen::Vector2d>;

  Path ground_truth, keyframes, predicted, lost;
  std::vector<Path> estimate;  // by submap, in order of FindSubMaps()
  std::vector<Path> odometry;  // without gaps
  std::vector<Path> sessions;
  std::vector<LineSegment2> lines[4];  // without axis, along axis 0, 1, 2
};

// The parts of a path between points that are not finite.
std::vector<TrajectoryDrawing::Path> ProjectParts(const std::vector<Eigen::Vector3d>& path,
                                                  const Projector& project) {
  std::vector<TrajectoryDrawing::Path> parts;
  bool is_gap = true;
  for (const Eigen::Vector3d& point : path) {
    if (point.allFinite()) {
      if (is_gap) parts.emplace_back();
      parts.back().push_back(project(point));
    }
    is_gap = !point.allFinite();
  }
  return parts;
}

void ProjectFrames(const ReportData& data, const Projector& project, TrajectoryDrawing* drawing) {
  std::map<int, size_t> indices;  // of submaps, by their numbers
  for (const SubMapStart& submap : FindSubMaps(data.frames)) {
    indices.emplace(submap.number, indices.size());
  }
  drawing->estimate.resize(indices.size());
  for (const ReportFrame& frame : data.frames) {
    if (frame.submap == kNoSubMapNumber) continue;
    const Eigen::Vector2d p = project(frame.world_from_cam.translation());
    drawing->estimate[indices.at(frame.submap)].push_back(p);
    if (frame.is_keyframe) drawing->keyframes.push_back(p);
    if (frame.status == ReportStatus::kPredicted) drawing->predicted.push_back(p);
    if (frame.status == ReportStatus::kLost) drawing->lost.push_back(p);
  }
}

TrajectoryDrawing Project(const ReportData& data, const Projector& project, bool with_lines) {
  TrajectoryDrawing drawing;
  ProjectFrames(data, project, &drawing);
  drawing.odometry = ProjectParts(data.odometry, project);
  for (const ReportSession& session : data.map.sessions) {
    drawing.sessions.emplace_back();
    for (const Eigen::Vector3d& x : session.positions)
      drawing.sessions.back().push_back(project(x));
  }
  for (const ReportGroundTruthPose& pose : data.ground_truth) {
    drawing.ground_truth.push_back(project(pose.position));
  }
  if (!with_lines) return drawing;
  for (const ReportLine& line : data.map.lines) {
    drawing.lines[std::clamp(line.axis, -1, 2) + 1].push_back(
        {project(line.segment.start), project(line.segment.end)});
  }
  return drawing;
}

// Covers the trajectory and 90 % of the ends of map lines.
PlotRange CoordinateRange(const TrajectoryDrawing& drawing, int axis) {
  std::vector<double> trajectory, line_ends;
  const auto add = [&](const TrajectoryDrawing::Path& path) {
    for (const Eigen::Vector2d& p : path) trajectory.push_back(p[axis]);
  };
  add(drawing.ground_truth);
  for (const auto* paths : {&drawing.estimate, &drawing.odometry, &drawing.sessions}) {
    for (const TrajectoryDrawing::Path& path : *paths) add(path);
  }
  for (const auto& lines : drawing.lines) {
    for (const LineSegment2& line : lines) {
      line_ends.insert(line_ends.end(), {line.start[axis], line.end[axis]});
    }
  }
  return Cover(trajectory, std::move(line_ends), 0.05);
}

SvgPlot MakeTrajectoryPlot(const TrajectoryDrawing& drawing) {
  PlotRange x = CoordinateRange(drawing, 0);
  PlotRange y = CoordinateRange(drawing, 1);
  // A flat trajectory gets a margin too, so that its curve is not at the edge of the drawing.
  const double shortest = 0.1 * std::max(x.Length(), y.Length());
  for (PlotRange* range : {&x, &y}) {
    const double margin = 0.05 * std::max(range->Length(), shortest);
    range->min -= margin;
    range->max += margin;
  }
  return SvgPlot::WithEqualAxes(kTrajectorySize, x, y);
}

}  // namespace

const char* ToString(ReportStatus status) {
  return EnumName<ReportStatus::kLost>(
      status, {"tracked", "weak", "dropped", "unreadable", "predicted", "lost"});
}

std::string LineClass(int axis) {
  return axis < 0 ? "map-line axis-none" : "map-line axis-" + std::to_string(axis);
}

std::string SubMapClass(size_t index) {
  constexpr size_t kNumColors = 6;
  const size_t color = index % kNumColors;
  return color == 0 ? "curve estimate" : "curve submap-" + std::to_string(color);
}

std::string SessionClass(size_t index) {
  constexpr size_t kNumColors = 3;
  return "curve session-" + std::to_string(index % kNumColors);
}

std::string DescribeFound(const ReportData& data) {
  const int frame = data.found_frame.value();
  const double time = data.frames.at(frame).timestamp - data.frames.front().timestamp;
  return "found in the map: frame " + std::to_string(frame) + ", " + FormatFixed(time, 2) + " s";
}

std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view,
                           TrajectorySide side) {
  const bool is_top = side == TrajectorySide::kTop;
  const Projector project = MakeProjector(view, side);
  const TrajectoryDrawing drawing = Project(data, project, is_top);
  SvgPlot plot = MakeTrajectoryPlot(drawing);
  plot.AddAxes("right, m", is_top ? "forward, m" : "up, m");
  for (int axis = -1; axis < 3; ++axis) {
    plot.AddSegments(drawing.lines[axis + 1], LineClass(axis));
  }
  plot.AddPath(drawing.ground_truth, "curve ground-truth");
  for (size_t i = 0; i < drawing.sessions.size(); ++i) {
    plot.AddPath(drawing.sessions[i], SessionClass(i));
  }
  for (const auto& part : drawing.odometry) plot.AddPath(part, "curve odometry");
  for (size_t i = 0; i < drawing.estimate.size(); ++i) {
    plot.AddPath(drawing.estimate[i], SubMapClass(i));
  }
  plot.AddDots(drawing.keyframes, kKeyframeRadius, "keyframe");
  plot.AddDots(drawing.predicted, kGapRadius, "status-predicted");
  plot.AddDots(drawing.lost, kGapRadius, "status-lost");
  if (!drawing.estimate.empty()) {
    plot.AddMarker(drawing.estimate.front().front(), kStartRadius, "start",
                   "start of the estimate");
  }
  if (data.found_frame) {
    const ReportFrame& found = data.frames.at(*data.found_frame);
    plot.AddMarker(project(found.world_from_cam.translation()), kStartRadius, "found",
                   DescribeFound(data));
  }
  return plot.ToString(is_top ? "Top view of the trajectory" : "Side view of the trajectory");
}

}  // namespace msc_vo
