// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/calibration_plots.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace msc_vo {
namespace {

using Residuals = std::vector<CalibrationResidual>;
using Points = std::vector<Eigen::Vector2d>;

// One member of the residuals, in the unit of its axis.
struct Quantity {
  double CalibrationResidual::*member;
  double scale;
  const char* name;
};

constexpr Quantity kRadius{&CalibrationResidual::radius, 1.0, "distance from the centre, px"};
constexpr Quantity kReprojection{&CalibrationResidual::reprojection, 1.0, "reprojection error, px"};
constexpr Quantity kDepth{&CalibrationResidual::depth, 1.0, "depth, m"};
constexpr Quantity kDepthError{&CalibrationResidual::depth_error, 100.0, "error of depth, %"};

constexpr char kGivenClass[] = "curve ground-truth";
constexpr char kEstimatedClass[] = "curve estimate";
// Part of a distribution that a plot shows; wrong matches lie beyond it.
constexpr double kShownRatio = 0.8;
constexpr double kPercent = 100.0;
// Bins of equal numbers of points, so that all medians are equally exact.
constexpr size_t kNumBins = 12;

std::vector<double> SortedValues(const Residuals& residuals, const Quantity& quantity) {
  std::vector<double> values;
  for (const CalibrationResidual& residual : residuals) {
    values.push_back(quantity.scale * residual.*quantity.member);
  }
  std::sort(values.begin(), values.end());
  return values;
}

// Percentage of the points whose value is at most x.
Points Distribution(const Residuals& residuals, const Quantity& quantity) {
  constexpr size_t kNumSteps = 200;
  const std::vector<double> values = SortedValues(residuals, quantity);
  Points curve;
  for (size_t i = 0; i <= kNumSteps && !values.empty(); ++i) {
    const double ratio = static_cast<double>(i) / kNumSteps;
    const auto index = static_cast<size_t>(ratio * static_cast<double>(values.size() - 1));
    curve.emplace_back(values[index], kPercent * ratio);
  }
  return curve;
}

// Medians of y over x.
Points MediansOver(Residuals residuals, const Quantity& x, const Quantity& y) {
  std::sort(residuals.begin(), residuals.end(),
            [&](const auto& a, const auto& b) { return a.*x.member < b.*x.member; });
  const size_t num_bins = std::min(kNumBins, residuals.size());
  Points curve;
  for (size_t bin = 0; bin < num_bins; ++bin) {
    const auto at = [&](size_t b) {
      return residuals.begin() + static_cast<std::ptrdiff_t>(b * residuals.size() / num_bins);
    };
    const Residuals part(at(bin), at(bin + 1));
    curve.emplace_back(x.scale * MedianResidual(part, x.member),
                       y.scale * MedianResidual(part, y.member));
  }
  return curve;
}

PlotFigure Plot(const std::array<Points, 2>& curves, const PlotRange& x, const PlotRange& y,
                const std::array<const char*, 2>& names) {
  constexpr SvgPlot::Size kSize{600, 320};
  SvgPlot::Margins margins;
  margins.bottom = 60.0;  // has the legend
  SvgPlot plot(kSize, x, y, margins);
  plot.AddAxes(names[0], names[1]);
  plot.AddSeries(curves[0], kGivenClass);
  std::vector<PlotLegendEntry> legend = {{kGivenClass, "given"}};
  if (!curves[1].empty()) {
    plot.AddSeries(curves[1], kEstimatedClass);
    legend.push_back({kEstimatedClass, "estimated"});
  }
  plot.AddLegend(legend);
  return {"", kSize, plot.ToString(std::string(names[1]) + " over " + names[0])};
}

PlotFigure PlotDistribution(const CalibrationResiduals& residuals, const Quantity& quantity) {
  const std::array<Points, 2> curves = {Distribution(residuals.given, quantity),
                                        Distribution(residuals.estimated, quantity)};
  PlotRange x{0.0, 0.0};
  for (const Points& curve : curves) {
    for (const Eigen::Vector2d& point : curve) {
      if (point.y() <= kPercent * kShownRatio) Include(point.x(), &x);
    }
  }
  return Plot(curves, x, {0.0, kPercent}, {quantity.name, "points with a smaller error, %"});
}

PlotFigure PlotMedians(const CalibrationResiduals& residuals, const Quantity& over,
                       const Quantity& quantity) {
  const std::array<Points, 2> curves = {MediansOver(residuals.given, over, quantity),
                                        MediansOver(residuals.estimated, over, quantity)};
  PlotRange x{0.0, 0.0}, y{0.0, 0.0};
  for (const Points& curve : curves) {
    for (const Eigen::Vector2d& point : curve) {
      Include(point.x(), &x);
      Include(1.05 * point.y(), &y);
    }
  }
  const std::string name = std::string("median ") + quantity.name;
  return Plot(curves, x, y, {over.name, name.c_str()});
}

}  // namespace

double MedianResidual(const Residuals& residuals, double CalibrationResidual::*member) {
  const std::vector<double> values = SortedValues(residuals, {member, 1.0, ""});
  return values[values.size() / 2];
}

std::vector<PlotFigure> PlotResiduals(const CalibrationResiduals& residuals) {
  if (residuals.given.empty()) return {};
  std::vector<PlotFigure> figures = {
      PlotDistribution(residuals, kReprojection), PlotMedians(residuals, kRadius, kReprojection),
      PlotDistribution(residuals, kDepthError), PlotMedians(residuals, kDepth, kDepthError)};
  figures[0].heading = "Reprojection error";
  figures[2].heading = "Depth error";
  return figures;
}

}  // namespace msc_vo
