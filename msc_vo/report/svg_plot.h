// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Closed interval of one coordinate of a plot.
struct PlotRange {
  double min = 0.0;
  double max = 1.0;

  double Length() const { return max - min; }
};

/// Extends the range to contain the value, unless the value is not finite.
void Include(double value, PlotRange* range);

/// Extends the range to contain the finite values, except the fraction `cut` of the smallest and
/// the same fraction of the largest ones: outliers must not shrink the rest of a plot.
void IncludeMost(std::vector<double> values, double cut, PlotRange* range);

/// The smallest range that contains all finite values of `all`, and of `most` what IncludeMost()
/// keeps; [0, 0] if there are none.
PlotRange Cover(const std::vector<double>& all, std::vector<double> most, double cut);

/// Multiples of 1, 2 or 5 times a power of ten inside `range`, at most `max_ticks` of them.
std::vector<double> NiceTicks(const PlotRange& range, int max_ticks);

/// One entry of a legend: a short line of the CSS class, followed by the label.
struct PlotLegendEntry {
  std::string css_class;
  std::string label;
};

/// A plot as an SVG element for a page with the style of the report. Arguments are in data
/// coordinates: x to the right, y upwards. Elements are drawn in the order in which they are added.
/// Points that are not finite are skipped.
class SvgPlot {
 public:
  /// Size in drawing units, which are CSS pixels unless the page scales the plot.
  struct Size {
    int width = 960;
    int height = 240;
  };
  /// Space around the data in drawing units. The default has room for ticks and names of axes.
  struct Margins {
    double left = 56.0;
    double right = 14.0;
    double top = 18.0;
    double bottom = 40.0;
  };

  SvgPlot(const Size& size, const PlotRange& x, const PlotRange& y, const Margins& margins);
  SvgPlot(const Size& size, const PlotRange& x, const PlotRange& y)
      : SvgPlot(size, x, y, Margins()) {}

  /// Both axes have the same scale: one range is extended on both sides to fill the drawing.
  static SvgPlot WithEqualAxes(const Size& size, const PlotRange& x, const PlotRange& y,
                               const Margins& margins);
  static SvgPlot WithEqualAxes(const Size& size, const PlotRange& x, const PlotRange& y) {
    return WithEqualAxes(size, x, y, Margins());
  }

  Eigen::Vector2d ToDrawing(const Eigen::Vector2d& point) const;

  /// Grid lines, ticks with their values, and the names of the axes.
  void AddAxes(const std::string& x_name, const std::string& y_name);
  /// A curve y(x) with increasing x. Of the points in one column of pixels, the first, lowest,
  /// highest and last are drawn.
  void AddSeries(const std::vector<Eigen::Vector2d>& points, const std::string& css_class);
  /// A path. Points closer than half a drawing unit to the previous one are skipped.
  void AddPath(const std::vector<Eigen::Vector2d>& points, const std::string& css_class);
  /// Segments, clipped at the axes.
  void AddSegments(const std::vector<LineSegment2>& segments, const std::string& css_class);
  void AddDots(const std::vector<Eigen::Vector2d>& points, double radius,
               const std::string& css_class);
  /// A dot with a tool tip.
  void AddMarker(const Eigen::Vector2d& point, double radius, const std::string& css_class,
                 const std::string& tip);
  /// A row below the plot, in the bottom margin.
  void AddLegend(const std::vector<PlotLegendEntry>& entries);

  /// The SVG element. `description`: alternative text for screen readers.
  std::string ToString(const std::string& description) const;

 private:
  double Left() const;
  double Right() const;
  double Top() const;
  double Bottom() const;
  void AppendPath(const std::vector<Eigen::Vector2d>& drawing_points, const std::string& css_class);
  void AppendText(const Eigen::Vector2d& at, const std::string& css_class, const std::string& text);
  std::vector<Eigen::Vector2d> ThinColumns(const std::vector<Eigen::Vector2d>& points) const;

  Size size_;
  Margins margins_;
  PlotRange x_;
  PlotRange y_;
  std::string inside_;   // clipped to the axes
  std::string outside_;  // labels
};

}  // namespace msc_vo
