// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

struct PlotRange {
  double min = 0.0;
  double max = 1.0;

  double Length() const { return max - min; }
};

/// Multiples of 1, 2 or 5 times a power of ten inside `range`, at most `max_ticks` of them.
std::vector<double> NiceTicks(const PlotRange& range, int max_ticks);

/// One plot with axes, as an SVG element for a page that has the style of the report. Data
/// coordinates go in; x grows to the right, y grows upwards. Elements are painted in the order in
/// which they are added. Points that are not finite are left out.
class SvgPlot {
 public:
  /// Size in the units of the drawing, which are CSS pixels unless the page scales it.
  struct Size {
    int width = 960;
    int height = 240;
  };

  SvgPlot(const Size& size, const PlotRange& x, const PlotRange& y);

  /// One unit is as long on both axes: one range grows, about its middle, to fill the drawing.
  static SvgPlot WithEqualAxes(const Size& size, const PlotRange& x, const PlotRange& y);

  const PlotRange& x_range() const { return x_; }
  const PlotRange& y_range() const { return y_; }
  /// Width of one drawing unit in units of x: nothing finer than this can be seen.
  double XResolution() const;
  Eigen::Vector2d ToDrawing(const Eigen::Vector2d& point) const;

  /// Ticks with their values, grid lines, and the names of the axes.
  void AddAxes(const std::string& x_name, const std::string& y_name);
  /// A curve y(x): x must not fall. Keeps first, lowest, highest and last point of every column.
  void AddSeries(const std::vector<Eigen::Vector2d>& points, const std::string& css_class);
  /// The same, filled down to the lower end of y.
  void AddArea(const std::vector<Eigen::Vector2d>& points, const std::string& css_class);
  /// A path through the plane. Points closer than half a drawing unit to the last are left out.
  void AddPath(const std::vector<Eigen::Vector2d>& points, const std::string& css_class);
  /// Segments are cut at the axes; those outside are left out.
  void AddSegments(const std::vector<LineSegment2>& segments, const std::string& css_class);
  void AddDots(const std::vector<Eigen::Vector2d>& points, double radius,
               const std::string& css_class);
  /// A dot with a tool tip.
  void AddMarker(const Eigen::Vector2d& point, double radius, const std::string& css_class,
                 const std::string& tip);
  /// A stretch of the strip above the plot, from x.min to x.max, with a tool tip.
  void AddStrip(const PlotRange& x, const std::string& css_class, const std::string& tip);

  /// The whole SVG element; `description` is for those who cannot see it.
  std::string ToString(const std::string& description) const;

 private:
  double Left() const;
  double Right() const;
  double Top() const;
  double Bottom() const;
  void AppendPath(const std::vector<Eigen::Vector2d>& drawing_points, const std::string& css_class,
                  bool closed);
  void AppendText(const Eigen::Vector2d& at, const std::string& css_class, const std::string& text);
  std::vector<Eigen::Vector2d> ThinColumns(const std::vector<Eigen::Vector2d>& points) const;

  Size size_;
  PlotRange x_;
  PlotRange y_;
  std::string inside_;   // clipped to the axes
  std::string outside_;  // labels and strips
};

}  // namespace msc_vo
