// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_plots.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "msc_vo/report/svg_plot.h"

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
  std::vector<Eigen::Vector2d> estimate, ground_truth, keyframes, predicted, lost;
  std::vector<LineSegment2> lines[4];  // without axis, along axis 0, 1, 2
};

TrajectoryDrawing Project(const ReportData& data, const Projector& project, bool with_lines) {
  TrajectoryDrawing drawing;
  for (const ReportFrame& frame : data.frames) {
    const Eigen::Vector2d p = project(frame.world_from_cam.translation());
    drawing.estimate.push_back(p);
    if (frame.is_keyframe) drawing.keyframes.push_back(p);
    if (frame.status == ReportStatus::kPredicted) drawing.predicted.push_back(p);
    if (frame.status == ReportStatus::kLost) drawing.lost.push_back(p);
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
  for (const auto* points : {&drawing.estimate, &drawing.ground_truth}) {
    for (const Eigen::Vector2d& p : *points) trajectory.push_back(p[axis]);
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
  switch (status) {
    case ReportStatus::kTracked:
      return "tracked";
    case ReportStatus::kWeak:
      return "weak";
    case ReportStatus::kDropped:
      return "dropped";
    case ReportStatus::kUnreadable:
      return "unreadable";
    case ReportStatus::kPredicted:
      return "predicted";
    case ReportStatus::kLost:
      return "lost";
  }
  return "unknown";
}

std::string LineClass(int axis) {
  return axis < 0 ? "map-line axis-none" : "map-line axis-" + std::to_string(axis);
}

std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view,
                           TrajectorySide side) {
  const bool is_top = side == TrajectorySide::kTop;
  const TrajectoryDrawing drawing = Project(data, MakeProjector(view, side), is_top);
  SvgPlot plot = MakeTrajectoryPlot(drawing);
  plot.AddAxes("right, m", is_top ? "forward, m" : "up, m");
  for (int axis = -1; axis < 3; ++axis) {
    plot.AddSegments(drawing.lines[axis + 1], LineClass(axis));
  }
  plot.AddPath(drawing.ground_truth, "curve ground-truth");
  plot.AddPath(drawing.estimate, "curve estimate");
  plot.AddDots(drawing.keyframes, kKeyframeRadius, "keyframe");
  plot.AddDots(drawing.predicted, kGapRadius, "status-predicted");
  plot.AddDots(drawing.lost, kGapRadius, "status-lost");
  plot.AddMarker(drawing.estimate.front(), kStartRadius, "start", "start of the estimate");
  return plot.ToString(is_top ? "Top view of the trajectory" : "Side view of the trajectory");
}

}  // namespace msc_vo
