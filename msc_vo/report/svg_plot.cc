// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "msc_vo/geometry/cell_index.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/report/html_text.h"

namespace msc_vo {
namespace {

// Spacing that one tick label needs along x and along y.
constexpr double kTickSpacingX = 80.0;
constexpr double kTickSpacingY = 28.0;
// Legend: length of a line, gaps, and average width of a character at the font size of the style.
constexpr double kSwatchLength = 20.0;
constexpr double kLegendGap = 6.0;
constexpr double kCharacterWidth = 6.4;

std::string Unit(double value) { return FormatFixed(value, 1); }

std::string PointText(const Eigen::Vector2d& p) { return Unit(p.x()) + ',' + Unit(p.y()); }

// The range, extended to a positive length.
PlotRange Widened(const PlotRange& range) {
  const double magnitude = std::max(std::abs(range.min), std::abs(range.max));
  if (range.Length() > 1e-9 * magnitude) return range;
  const double half = magnitude > 0.0 ? 0.5 * magnitude : 0.5;
  return {range.min - half, range.max + half};
}

double NiceStep(double length, int max_ticks) {
  const double raw = length / std::max(1, max_ticks);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

// Number of decimals that distinguishes the ticks.
int DecimalsOf(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return 1;
  return CellIndex(std::ceil(-std::log10(ticks[1] - ticks[0]) - 1e-9), 10);
}

// The part of the segment inside the rectangle of `low` and `high` (Liang and Barsky 1984), or
// nullopt.
std::optional<LineSegment2> Clipped(const LineSegment2& segment, const Eigen::Vector2d& low,
                                    const Eigen::Vector2d& high) {
  const Eigen::Vector2d direction = segment.end - segment.start;
  double from = 0.0, to = 1.0;  // along the segment
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) {
      if (segment.start[axis] < low[axis] || segment.start[axis] > high[axis]) return std::nullopt;
      continue;
    }
    const double a = (low[axis] - segment.start[axis]) / direction[axis];
    const double b = (high[axis] - segment.start[axis]) / direction[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (from > to) return std::nullopt;
  return LineSegment2{segment.start + from * direction, segment.start + to * direction};
}

}  // namespace

void Include(double value, PlotRange* range) {
  if (!std::isfinite(value)) return;
  range->min = std::min(range->min, value);
  range->max = std::max(range->max, value);
}

void IncludeMost(std::vector<double> values, double cut, PlotRange* range) {
  EraseIf(&values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto num_cut = static_cast<size_t>(cut * static_cast<double>(values.size()));
  Include(values[num_cut], range);
  Include(values[values.size() - 1 - num_cut], range);
}

PlotRange Cover(const std::vector<double>& all, std::vector<double> most, double cut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PlotRange range{kInfinity, -kInfinity};
  for (const double value : all) Include(value, &range);
  IncludeMost(std::move(most), cut, &range);
  return range.min > range.max ? PlotRange{0.0, 0.0} : range;
}

std::vector<double> NiceTicks(const PlotRange& range, int max_ticks) {
  const double step = NiceStep(range.Length(), max_ticks);
  std::vector<double> ticks;
  // Multiples instead of sums, so that rounding errors do not accumulate. The slack keeps ticks at
  // the ends.
  const double first = std::ceil(range.min / step - 1e-9);
  for (double i = first; i * step <= range.max + 1e-9 * step; i += 1.0) ticks.push_back(i * step);
  return ticks;
}

SvgPlot::SvgPlot(const Size& size, const PlotRange& x, const PlotRange& y, const Margins& margins)
    : size_(size), margins_(margins), x_(Widened(x)), y_(Widened(y)) {}

SvgPlot SvgPlot::WithEqualAxes(const Size& size, const PlotRange& x, const PlotRange& y,
                               const Margins& margins) {
  SvgPlot plot(size, x, y, margins);
  const double width = plot.Right() - plot.Left();
  const double height = plot.Bottom() - plot.Top();
  const double unit = std::max(plot.x_.Length() / width, plot.y_.Length() / height);
  const auto grow = [](double length, PlotRange* range) {
    const double missing = length - range->Length();
    range->min -= 0.5 * missing;
    range->max += 0.5 * missing;
  };
  grow(unit * width, &plot.x_);
  grow(unit * height, &plot.y_);
  return plot;
}

double SvgPlot::Left() const { return margins_.left; }
double SvgPlot::Right() const { return size_.width - margins_.right; }
double SvgPlot::Top() const { return margins_.top; }
double SvgPlot::Bottom() const { return size_.height - margins_.bottom; }

Eigen::Vector2d SvgPlot::ToDrawing(const Eigen::Vector2d& point) const {
  return {Left() + (point.x() - x_.min) / x_.Length() * (Right() - Left()),
          Bottom() - (point.y() - y_.min) / y_.Length() * (Bottom() - Top())};
}

void SvgPlot::AppendText(const Eigen::Vector2d& at, const std::string& css_class,
                         const std::string& text) {
  outside_ += "<text class=\"" + css_class + "\" x=\"" + Unit(at.x()) + "\" y=\"" + Unit(at.y()) +
              "\">" + EscapeHtml(text) + "</text>\n";
}

void SvgPlot::AddAxes(const std::string& x_name, const std::string& y_name) {
  const std::vector<double> x_ticks =
      NiceTicks(x_, static_cast<int>((Right() - Left()) / kTickSpacingX));
  const std::vector<double> y_ticks =
      NiceTicks(y_, static_cast<int>((Bottom() - Top()) / kTickSpacingY));
  std::vector<LineSegment2> grid;
  for (const double tick : x_ticks) {
    grid.push_back({Eigen::Vector2d(tick, y_.min), Eigen::Vector2d(tick, y_.max)});
    AppendText({ToDrawing({tick, y_.min}).x(), Bottom() + 15.0}, "tick-x",
               FormatFixed(tick, DecimalsOf(x_ticks)));
  }
  for (const double tick : y_ticks) {
    grid.push_back({Eigen::Vector2d(x_.min, tick), Eigen::Vector2d(x_.max, tick)});
    AppendText({Left() - 6.0, ToDrawing({x_.min, tick}).y() + 4.0}, "tick-y",
               FormatFixed(tick, DecimalsOf(y_ticks)));
  }
  AddSegments(grid, "grid");
  AppendText({0.5 * (Left() + Right()), size_.height - 6.0}, "tick-x name", x_name);
  outside_ += "<text class=\"tick-x name\" transform=\"translate(13," +
              Unit(0.5 * (Top() + Bottom())) + ") rotate(-90)\">" + EscapeHtml(y_name) +
              "</text>\n";
}

void SvgPlot::AppendPath(const std::vector<Eigen::Vector2d>& drawing_points,
                         const std::string& css_class) {
  if (drawing_points.empty()) return;
  inside_ += "<polyline class=\"" + css_class + "\" points=\"";
  for (const Eigen::Vector2d& p : drawing_points) inside_ += PointText(p) + ' ';
  inside_.back() = '"';
  inside_ += "/>\n";
}

std::vector<Eigen::Vector2d> SvgPlot::ThinColumns(
    const std::vector<Eigen::Vector2d>& points) const {
  std::vector<Eigen::Vector2d> thin;
  std::vector<Eigen::Vector2d> column;
  const auto flush = [&] {
    const auto lower = [](const auto& a, const auto& b) { return a.y() < b.y(); };
    const auto [low, high] = std::minmax_element(column.begin(), column.end(), lower);
    for (auto it = column.begin(); it != column.end(); ++it) {
      if (it == low || it == high || it == column.begin() || it + 1 == column.end()) {
        thin.push_back(*it);
      }
    }
    column.clear();
  };
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    const Eigen::Vector2d drawn = ToDrawing(point);
    if (!column.empty() && std::floor(drawn.x()) != std::floor(column.front().x())) flush();
    column.push_back(drawn);
  }
  if (!column.empty()) flush();
  return thin;
}

void SvgPlot::AddSeries(const std::vector<Eigen::Vector2d>& points, const std::string& css_class) {
  AppendPath(ThinColumns(points), css_class);
}

void SvgPlot::AddPath(const std::vector<Eigen::Vector2d>& points, const std::string& css_class) {
  std::vector<Eigen::Vector2d> thin;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    last = ToDrawing(point);
    if (thin.empty() || (last - thin.back()).norm() >= 0.5) thin.push_back(last);
  }
  if (!thin.empty() && thin.back() != last) thin.push_back(last);
  AppendPath(thin, css_class);
}

void SvgPlot::AddSegments(const std::vector<LineSegment2>& segments, const std::string& css_class) {
  std::string path;
  for (const LineSegment2& segment : segments) {
    if (!segment.start.allFinite() || !segment.end.allFinite()) continue;
    const auto visible = Clipped(segment, {x_.min, y_.min}, {x_.max, y_.max});
    if (!visible) continue;
    path += 'M' + PointText(ToDrawing(visible->start)) + 'L' + PointText(ToDrawing(visible->end));
  }
  if (path.empty()) return;
  inside_ += "<path class=\"" + css_class + "\" d=\"" + path + "\"/>\n";
}

void SvgPlot::AddDots(const std::vector<Eigen::Vector2d>& points, double radius,
                      const std::string& css_class) {
  std::string dots;
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    const Eigen::Vector2d p = ToDrawing(point);
    dots += "<circle cx=\"" + Unit(p.x()) + "\" cy=\"" + Unit(p.y()) + "\" r=\"" + Unit(radius) +
            "\"/>";
  }
  if (dots.empty()) return;
  inside_ += "<g class=\"" + css_class + "\">" + dots + "</g>\n";
}

void SvgPlot::AddMarker(const Eigen::Vector2d& point, double radius, const std::string& css_class,
                        const std::string& tip) {
  if (!point.allFinite()) return;
  const Eigen::Vector2d p = ToDrawing(point);
  inside_ += "<circle class=\"" + css_class + "\" cx=\"" + Unit(p.x()) + "\" cy=\"" + Unit(p.y()) +
             "\" r=\"" + Unit(radius) + "\"><title>" + EscapeHtml(tip) + "</title></circle>\n";
}

void SvgPlot::AddLegend(const std::vector<PlotLegendEntry>& entries) {
  double x = Left();
  const double y = size_.height - 10.0;
  for (const PlotLegendEntry& entry : entries) {
    outside_ += "<path class=\"" + entry.css_class + "\" d=\"M" + PointText({x, y - 4.0}) + 'L' +
                PointText({x + kSwatchLength, y - 4.0}) + "\"/>\n";
    x += kSwatchLength + kLegendGap;
    AppendText({x, y}, "name", entry.label);
    x += kCharacterWidth * static_cast<double>(entry.label.size()) + 3.0 * kLegendGap;
  }
}

std::string SvgPlot::ToString(const std::string& description) const {
  // A nested <svg> clips at the axes and, unlike a clip path, needs no unique id.
  const std::string width = Unit(Right() - Left());
  const std::string height = Unit(Bottom() - Top());
  const std::string box = Unit(Left()) + ' ' + Unit(Top()) + ' ' + width + ' ' + height;
  return "<svg viewBox=\"0 0 " + std::to_string(size_.width) + ' ' + std::to_string(size_.height) +
         "\" role=\"img\" aria-label=\"" + EscapeHtml(description) + "\">\n<svg x=\"" +
         Unit(Left()) + "\" y=\"" + Unit(Top()) + "\" width=\"" + width + "\" height=\"" + height +
         "\" viewBox=\"" + box + "\">\n" + inside_ + "</svg>\n" + outside_ + "</svg>\n";
}

}  // namespace msc_vo
