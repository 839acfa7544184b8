// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/report/report.h"
#include "msc_vo/report/svg_plot.h"

namespace msc_vo {

/// A plot with its place on a page.
struct PlotFigure {
  std::string heading;  ///< on pages only; empty: belongs to the figure before
  SvgPlot::Size size;   ///< figures of at most 600 drawing units stand side by side
  std::string svg;
};

/// Numbers and plots on one page, as plain data.
struct PlotPage {
  std::string title;
  std::string command_line;
  std::vector<ReportNumber> numbers;  ///< on pages only, above the plots
  std::vector<PlotFigure> figures;
};

/// An HTML page, without scripts or external files.
std::string FormatPageHtml(const PlotPage& page);

/// The plots as one SVG image.
std::string FormatPageSvg(const PlotPage& page);

}  // namespace msc_vo
