// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_plots.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/svg_plot.h"

namespace msc_vo {
namespace {

constexpr SvgPlot::Size kTrajectorySize{600, 460};
constexpr SvgPlot::Size kSeriesSize{1200, 240};
constexpr double kKeyframeRadius = 2.4;
constexpr double kGapRadius = 2.2;
constexpr double kStartRadius = 5.0;

double TimeOf(const ReportData& data, size_t frame) {
  return data.frames[frame].timestamp - data.frames.front().timestamp;
}

// A frame lasts until the next one, the last frame as long as the average.
PlotRange TimeRange(const ReportData& data) {
  const double last = TimeOf(data, data.frames.size() - 1);
  const double mean = data.frames.size() > 1 ? last / (data.frames.size() - 1.0) : 1.0;
  return {0.0, last + mean};
}

// From zero to a little above the largest value.
PlotRange RangeFromZero(const std::vector<Eigen::Vector2d>& points) {
  PlotRange range{0.0, 0.0};
  for (const Eigen::Vector2d& point : points) Include(1.05 * point.y(), &range);
  return range;
}

template <typename ValueOf>
std::vector<Eigen::Vector2d> Series(const ReportData& data, const ValueOf& value_of) {
  std::vector<Eigen::Vector2d> points;
  for (size_t i = 0; i < data.frames.size(); ++i) {
    points.emplace_back(TimeOf(data, i), value_of(data.frames[i]));
  }
  return points;
}

// The status of each frame as a strip above the plot. Stretches shorter than one drawing unit are
// merged and get the worst status among them.
void AddStatusStrip(const ReportData& data, SvgPlot* plot) {
  const double resolution = plot->XResolution();
  const size_t count = data.frames.size();
  for (size_t first = 0; first < count;) {
    ReportStatus status = data.frames[first].status;
    size_t end = first + 1;
    while (end < count && (data.frames[end].status == status ||
                           TimeOf(data, end) - TimeOf(data, first) < resolution)) {
      status = std::max(status, data.frames[end++].status);
    }
    const PlotRange span{TimeOf(data, first),
                         end < count ? TimeOf(data, end) : plot->x_range().max};
    plot->AddStrip(span, std::string("status-") + ToString(status),
                   std::string(ToString(status)) + ": frames " + std::to_string(first) + " to " +
                       std::to_string(end - 1) + ", from " + FormatFixed(span.min, 2) + " s");
    first = end;
  }
}

std::string PlotCurve(const ReportData& data, const std::vector<Eigen::Vector2d>& points,
                      const std::string& css_class, const std::string& y_name,
                      const std::string& description) {
  SvgPlot plot(kSeriesSize, TimeRange(data), RangeFromZero(points));
  plot.AddAxes("time, s", y_name);
  plot.AddSeries(points, css_class);
  AddStatusStrip(data, &plot);
  return plot.ToString(description);
}

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

std::string PlotError(const ReportData& data) {
  std::vector<Eigen::Vector2d> points;
  for (size_t i = 0; i < data.frames.size(); ++i) {
    const std::optional<double>& error = data.frames[i].position_error;
    if (error) points.emplace_back(TimeOf(data, i), 1000.0 * *error);
  }
  return PlotCurve(data, points, "curve error", "position error, mm", "Position error over time");
}

std::string PlotInliers(const ReportData& data) {
  const auto points =
      Series(data, [](const ReportFrame& frame) { return frame.num_inlier_points; });
  const auto lines = Series(data, [](const ReportFrame& frame) { return frame.num_inlier_lines; });
  PlotRange range = RangeFromZero(points);
  Include(RangeFromZero(lines).max, &range);
  SvgPlot plot(kSeriesSize, TimeRange(data), range);
  plot.AddAxes("time, s", "inliers");
  plot.AddSeries(points, "curve points");
  plot.AddSeries(lines, "curve lines");
  AddStatusStrip(data, &plot);
  return plot.ToString("Inlier points and lines over time");
}

std::string PlotStages(const ReportData& data) {
  const auto whole = Series(data, [](const ReportFrame& frame) { return frame.tracking_ms; });
  // Sums of the stages up to each. Drawn from the highest sum down, so that lower ones stay
  // visible.
  std::vector<std::vector<Eigen::Vector2d>> sums;
  for (size_t stage = 0; stage < data.stages.size(); ++stage) {
    if (!data.stages[stage].is_stacked) continue;
    sums.push_back(Series(data, [&data, stage](const ReportFrame& frame) {
      double sum = 0.0;
      for (size_t i = 0; i <= stage; ++i) {
        if (data.stages[i].is_stacked) sum += frame.stage_ms[i];
      }
      return sum;
    }));
  }
  PlotRange range = RangeFromZero(whole);
  if (!sums.empty()) Include(RangeFromZero(sums.back()).max, &range);
  SvgPlot plot(kSeriesSize, TimeRange(data), range);
  plot.AddAxes("time, s", "tracking, ms");
  for (size_t i = sums.size(); i-- > 0;) {
    plot.AddArea(sums[i], "stage-" + std::to_string(i % 6));
  }
  plot.AddSeries(whole, "curve whole");
  return plot.ToString("Time of the stages of tracking, over time");
}

std::string PlotMapping(const ReportData& data) {
  std::vector<Eigen::Vector2d> steps;
  for (size_t i = 0; i < data.frames.size(); ++i) {
    const double ms = data.frames[i].mapping_ms;
    if (ms > 0.0) steps.emplace_back(TimeOf(data, i), ms);
  }
  SvgPlot plot(kSeriesSize, TimeRange(data), RangeFromZero(steps));
  plot.AddAxes("time, s", "mapping, ms");
  std::vector<LineSegment2> stems;
  for (const Eigen::Vector2d& step : steps) {
    stems.push_back({Eigen::Vector2d(step.x(), 0.0), step});
  }
  plot.AddSegments(stems, "stem");
  plot.AddDots(steps, kGapRadius, "fill-mapping");
  return plot.ToString("Time of each keyframe step");
}

}  // namespace msc_vo
