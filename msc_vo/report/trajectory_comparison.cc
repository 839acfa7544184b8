// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/trajectory_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/report/svg_plot.h"

namespace msc_vo {
namespace {

constexpr SvgPlot::Size kPlaneSize{600, 460};
constexpr SvgPlot::Size kSeriesSize{1200, 200};
constexpr SvgPlot::Size kLastSeriesSize{1200, 230};  // has the legend
constexpr double kStartRadius = 5.0;
constexpr double kMillimetres = 1000.0;  // per metre
constexpr char kReferenceClass[] = "curve ground-truth";
constexpr char kEstimateClass[] = "curve estimate";

using Points = std::vector<Eigen::Vector2d>;

Points InPlane(const std::vector<TimedPose>& poses, int x, int y) {
  Points points;
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d t = pose.world_from_cam.translation();
    points.emplace_back(t[x], t[y]);
  }
  return points;
}

PlotRange RangeOf(const Points& a, const Points& b, int coordinate, double margin) {
  std::vector<double> values;
  for (const Points* points : {&a, &b}) {
    for (const Eigen::Vector2d& point : *points) values.push_back(point[coordinate]);
  }
  PlotRange range = Cover(values, {}, 0.0);
  const double space = margin * range.Length();
  return {range.min - space, range.max + space};
}

std::string PlotPlane(const TrajectoryComparison& comparison, int x, int y) {
  constexpr const char* kNames[] = {"x, m", "y, m", "z, m"};
  const Points reference = InPlane(comparison.reference, x, y);
  const Points estimate = InPlane(comparison.estimate, x, y);
  SvgPlot::Margins margins;
  margins.bottom = 60.0;  // has the legend
  SvgPlot plot = SvgPlot::WithEqualAxes(kPlaneSize, RangeOf(reference, estimate, 0, 0.05),
                                        RangeOf(reference, estimate, 1, 0.05), margins);
  plot.AddAxes(kNames[x], kNames[y]);
  plot.AddPath(reference, kReferenceClass);
  plot.AddPath(estimate, kEstimateClass);
  plot.AddMarker(estimate.front(), kStartRadius, "start", "start of the estimate");
  plot.AddLegend({{kReferenceClass, "reference"}, {kEstimateClass, "estimate"}});
  return plot.ToString(std::string("Trajectories in the plane of ") + kNames[x][0] + " and " +
                       kNames[y][0]);
}

// One value per pose over time, and the same of the other trajectory.
PlotFigure PlotSeries(const TrajectoryComparison& comparison, const Points& reference,
                      const Points& estimate, const std::string& name) {
  SvgPlot plot(kSeriesSize, RangeOf(reference, estimate, 0, 0.0),
               RangeOf(reference, estimate, 1, 0.05));
  plot.AddAxes(comparison.has_stamps ? "time, s" : "pose", name);
  plot.AddSeries(reference, kReferenceClass);
  plot.AddSeries(estimate, kEstimateClass);
  return {"", kSeriesSize, plot.ToString(name + " over time")};
}

template <typename ValueOf>
Points Series(const std::vector<TimedPose>& poses, double start, const ValueOf& value_of) {
  Points points;
  for (const TimedPose& pose : poses) points.emplace_back(pose.timestamp - start, value_of(pose));
  return points;
}

// Adds full turns so that no value differs from the one before by more than half a turn. The first
// is moved next to `first`.
void Unwrap(double first, Points* points) {
  double previous = first;
  for (Eigen::Vector2d& point : *points) {
    point.y() -= 360.0 * std::round((point.y() - previous) / 360.0);
    previous = point.y();
  }
}

void AddPositionFigures(const TrajectoryComparison& comparison, double start,
                        std::vector<PlotFigure>* figures) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = [axis](const TimedPose& pose) {
      return pose.world_from_cam.translation()[axis];
    };
    figures->push_back(PlotSeries(comparison, Series(comparison.reference, start, value),
                                  Series(comparison.estimate, start, value),
                                  std::string(1, "xyz"[axis]) + ", m"));
    if (axis == 0) figures->back().heading = "Position over time";
  }
}

void AddRotationFigures(const TrajectoryComparison& comparison, double start,
                        std::vector<PlotFigure>* figures) {
  constexpr const char* kNames[] = {"roll, degrees", "pitch, degrees", "yaw, degrees"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = [axis](const TimedPose& pose) {
      return RollPitchYaw(pose.world_from_cam.rotation())[axis];
    };
    Points reference = Series(comparison.reference, start, value);
    Points estimate = Series(comparison.estimate, start, value);
    Unwrap(reference.front().y(), &reference);
    Unwrap(reference.front().y(), &estimate);
    figures->push_back(PlotSeries(comparison, reference, estimate, kNames[axis]));
    if (axis == 0) figures->back().heading = "Roll, pitch and yaw over time";
  }
}

PlotFigure PlotApe(const TrajectoryComparison& comparison, double start) {
  Points points;
  PlotRange range{0.0, 0.0};
  for (size_t i = 0; i < comparison.ape.size(); ++i) {
    points.emplace_back(comparison.estimate[i].timestamp - start, kMillimetres * comparison.ape[i]);
    Include(1.05 * points.back().y(), &range);
  }
  SvgPlot::Margins margins;
  margins.bottom = 60.0;  // has the legend
  SvgPlot plot(kLastSeriesSize, RangeOf(points, points, 0, 0.0), range, margins);
  plot.AddAxes(comparison.has_stamps ? "time, s" : "pose", "APE, mm");
  const double from = points.front().x(), to = points.back().x();
  const std::pair<double, const char*> levels[] = {{comparison.ape_rmse, "curve lines"},
                                                   {comparison.ape_mean, "curve points"},
                                                   {comparison.ape_median, "curve whole"}};
  for (const auto& [level, css_class] : levels) {
    const double y = kMillimetres * level;
    plot.AddSegments({{Eigen::Vector2d(from, y), Eigen::Vector2d(to, y)}}, css_class);
  }
  plot.AddSeries(points, "curve error");
  plot.AddLegend({{"curve error", "APE"},
                  {"curve lines", "RMSE"},
                  {"curve points", "mean"},
                  {"curve whole", "median"}});
  return {"Absolute position error over time", kLastSeriesSize,
          plot.ToString("Absolute position error over time")};
}

std::vector<PlotFigure> PlotAll(const TrajectoryComparison& comparison) {
  std::vector<PlotFigure> figures;
  if (comparison.estimate.empty()) return figures;
  for (const auto& [x, y] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
    figures.push_back({"", kPlaneSize, PlotPlane(comparison, x, y)});
  }
  figures.front().heading = "Trajectory";
  const double start = comparison.has_stamps ? comparison.reference.front().timestamp : 0.0;
  figures.push_back(PlotApe(comparison, start));
  AddPositionFigures(comparison, start, &figures);
  AddRotationFigures(comparison, start, &figures);
  return figures;
}

}  // namespace

Eigen::Vector3d RollPitchYaw(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  return RadiansToDegrees(1.0) *
         Eigen::Vector3d(std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0)));
}

PlotPage ComparisonPage(const TrajectoryComparison& comparison) {
  return {comparison.title, comparison.command_line, comparison.numbers, PlotAll(comparison)};
}

}  // namespace msc_vo
