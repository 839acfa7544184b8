// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_plots.h"

#include <algorithm>
#include <cmath>
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

// A frame lasts until the next one; the last as long as the frames do on average.
PlotRange TimeRange(const ReportData& data) {
  const double last = TimeOf(data, data.frames.size() - 1);
  const double mean = data.frames.size() > 1 ? last / (data.frames.size() - 1.0) : 1.0;
  return {0.0, last + mean};
}

void Include(double value, PlotRange* range) {
  if (!std::isfinite(value)) return;
  range->min = std::min(range->min, value);
  range->max = std::max(range->max, value);
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

// The status of each frame as a strip above the plot. Runs shorter than the eye can tell apart
// become one, with the worst status in it.
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

// Projects world coordinates onto the page.
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

// Covers [min, max] of the trajectory and the middle 90 % of the ends of map lines: a few lines
// with a wrong depth must not shrink the rest. A camera that only turns sees lines far beyond its
// own path, which the view from the side shows large.
PlotRange CoverTrajectoryAndLines(const std::vector<double>& trajectory, double extent,
                                  std::vector<double> line_ends) {
  PlotRange range{trajectory.front(), trajectory.front()};
  for (const double value : trajectory) Include(value, &range);
  if (!line_ends.empty()) {
    std::sort(line_ends.begin(), line_ends.end());
    const size_t cut = line_ends.size() / 20;
    Include(line_ends[cut], &range);
    Include(line_ends[line_ends.size() - 1 - cut], &range);
  }
  const double margin = 0.05 * std::max(range.Length(), 0.1 * extent);
  return {range.min - margin, range.max + margin};
}

struct TrajectoryDrawing {
  std::vector<Eigen::Vector2d> estimate, truth, keyframes, predicted, lost;
  std::vector<LineSegment2> lines[4];  // of no axis, of axis 0, 1, 2
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
  for (const ReportTruthPose& pose : data.truth) drawing.truth.push_back(project(pose.position));
  if (!with_lines) return drawing;
  for (const ReportLine& line : data.lines) {
    drawing.lines[std::clamp(line.axis, -1, 2) + 1].push_back(
        {project(line.segment.start), project(line.segment.end)});
  }
  return drawing;
}

SvgPlot MakeTrajectoryPlot(const TrajectoryDrawing& drawing) {
  std::vector<Eigen::Vector2d> trajectory;
  for (const auto* points : {&drawing.estimate, &drawing.truth}) {
    for (const Eigen::Vector2d& p : *points) {
      if (p.allFinite()) trajectory.push_back(p);
    }
  }
  if (trajectory.empty()) trajectory.emplace_back(0.0, 0.0);
  std::vector<double> coordinates[2], line_ends[2];
  double extent = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    PlotRange range{trajectory.front()[axis], trajectory.front()[axis]};
    for (const Eigen::Vector2d& p : trajectory) {
      coordinates[axis].push_back(p[axis]);
      Include(p[axis], &range);
    }
    extent = std::max(extent, range.Length());
    for (const auto& lines : drawing.lines) {
      for (const LineSegment2& line : lines) {
        for (const double end : {line.start[axis], line.end[axis]}) {
          if (std::isfinite(end)) line_ends[axis].push_back(end);
        }
      }
    }
  }
  return SvgPlot::WithEqualAxes(kTrajectorySize,
                                CoverTrajectoryAndLines(coordinates[0], extent, line_ends[0]),
                                CoverTrajectoryAndLines(coordinates[1], extent, line_ends[1]));
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
  return axis < 0 ? "map-line" : "map-line axis-" + std::to_string(axis);
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
  plot.AddPath(drawing.truth, "curve truth");
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
  // The sum of the stages up to each; painted from the highest down, the lower ones stay on top.
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
