// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/plot_page.h"

#include <algorithm>

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/web_assets.h"

namespace msc_vo {
namespace {

constexpr int kSheetWidth = 1200;
constexpr int kGap = 12;

bool IsNarrow(const PlotFigure& figure) { return 2 * figure.size.width <= kSheetWidth; }

std::string NumbersHtml(const std::vector<ReportNumber>& numbers) {
  std::string html = "<dl class=\"numbers\">\n";
  for (const ReportNumber& number : numbers) {
    html += "<div><dt>" + EscapeHtml(number.name) + "</dt><dd class=\"value\">" +
            EscapeHtml(number.value) + "</dd><dd class=\"note\">" + EscapeHtml(number.note) +
            "</dd></div>\n";
  }
  return html + "</dl>\n";
}

}  // namespace

std::string FormatPageHtml(const PlotPage& page) {
  std::string html = PageHead(page.title) + "<p><code>" + EscapeHtml(page.command_line) +
                     "</code></p>\n" + NumbersHtml(page.numbers);
  bool in_views = false;
  for (const PlotFigure& figure : page.figures) {
    if (in_views && (!IsNarrow(figure) || !figure.heading.empty())) {
      html += "</div>\n";
      in_views = false;
    }
    if (!figure.heading.empty()) html += "<h2>" + EscapeHtml(figure.heading) + "</h2>\n";
    if (!in_views && IsNarrow(figure)) {
      html += "<div class=\"views\">\n";
      in_views = true;
    }
    html += "<figure>\n" + figure.svg + "</figure>\n";
  }
  if (in_views) html += "</div>\n";
  return html + "</body>\n</html>\n";
}

std::string FormatPageSvg(const PlotPage& page) {
  std::string plots;
  int top = kGap;
  int left = 0;
  int row_height = 0;
  for (const PlotFigure& figure : page.figures) {
    if (left + figure.size.width > kSheetWidth) {
      top += row_height + kGap;
      left = 0;
      row_height = 0;
    }
    constexpr size_t kTagLength = 4;  // "<svg"
    plots += "<svg x=\"" + std::to_string(left) + "\" y=\"" + std::to_string(top) + "\" width=\"" +
             std::to_string(figure.size.width) + "\" height=\"" +
             std::to_string(figure.size.height) + "\"" + figure.svg.substr(kTagLength);
    left += figure.size.width;
    row_height = std::max(row_height, figure.size.height);
  }
  const std::string width = std::to_string(kSheetWidth);
  const std::string height = std::to_string(top + row_height + kGap);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
         "\" viewBox=\"0 0 " + width + " " + height + "\" font-family=\"sans-serif\">\n<title>" +
         EscapeHtml(page.title) + "</title>\n<style>" + std::string(kReportStyle) +
         "\n.paper { fill: var(--paper); }\n</style>\n<rect class=\"paper\" width=\"100%\" "
         "height=\"100%\"/>\n" +
         plots + "</svg>\n";
}

}  // namespace msc_vo
