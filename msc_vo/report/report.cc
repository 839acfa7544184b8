// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/report_plots.h"
#include "msc_vo/report/report_statistics.h"
#include "msc_vo/report/run_json.h"
#include "msc_vo/report/trajectory_view.h"
#include "msc_vo/report/viewer_page.h"

namespace msc_vo {
namespace {

enum class Swatch { kCurve, kFill };

struct LegendEntry {
  Swatch swatch;
  std::string css_class;
  std::string label;
};

constexpr std::array<ReportStatus, 6> kAllStatuses = {
    ReportStatus::kTracked,    ReportStatus::kWeak,      ReportStatus::kDropped,
    ReportStatus::kUnreadable, ReportStatus::kPredicted, ReportStatus::kLost};

void CheckStages(const ReportData& data) {
  for (size_t i = 0; i < data.frames.size(); ++i) {
    if (data.frames[i].stage_ms.size() == data.stages.size()) continue;
    throw std::invalid_argument("ReportData: frame " + std::to_string(i) + " has " +
                                std::to_string(data.frames[i].stage_ms.size()) +
                                " stage times, but there are " +
                                std::to_string(data.stages.size()) + " stages");
  }
}

// `attribute`: what the script does with the figure, such as data-chart="error": draw a plot over
// time (web/charts.js).
void WriteFigure(const std::string& svg, const std::vector<LegendEntry>& legend, std::ostream& out,
                 const std::string& attribute, const std::string& caption = "") {
  out << "<figure " << attribute << ">\n<figcaption>" << EscapeHtml(caption)
      << "<ul class=\"legend\">";
  for (const LegendEntry& entry : legend) {
    out << "<li><svg viewBox=\"0 0 18 10\" aria-hidden=\"true\">";
    if (entry.swatch == Swatch::kCurve) {
      out << "<path class=\"" << entry.css_class << "\" d=\"M0 5H18\"/>";
    } else {
      out << "<rect class=\"" << entry.css_class << "\" width=\"18\" height=\"10\"/>";
    }
    out << "</svg>" << EscapeHtml(entry.label) << "</li>";
  }
  out << "</ul></figcaption>\n" << svg << "</figure>\n";
}

void WriteHeader(const ReportData& data, std::ostream& out) {
  WritePageHead(data.title, PageConnections::kNone, out);
  out << "<body>\n<h1>" << EscapeHtml(data.title) << "</h1>\n<p><code>"
      << EscapeHtml(data.command_line) << "</code></p>\n";
}

// Short values are shown as tiles, long ones as rows of a table below the viewer.
bool IsTile(const ReportNumber& number) {
  constexpr size_t kMaxLength = 16;  // characters that fit a tile on one line
  return number.value.size() <= kMaxLength;
}

void WriteTiles(const ReportData& data, std::ostream& out) {
  out << "<dl class=\"numbers\">\n";
  for (const ReportNumber& number : data.numbers) {
    if (!IsTile(number)) continue;
    out << "<div><dt>" << EscapeHtml(number.name) << "</dt><dd class=\"value\">"
        << EscapeHtml(number.value) << "</dd><dd class=\"note\">" << EscapeHtml(number.note)
        << "</dd></div>\n";
  }
  out << "</dl>\n";
}

void WriteFacts(const std::vector<ReportNumber>& numbers, std::ostream& out) {
  if (numbers.empty()) return;
  out << "<table class=\"facts\">\n";
  for (const ReportNumber& number : numbers) {
    out << "<tr><th>" << EscapeHtml(number.name) << "</th><td>" << EscapeHtml(number.value)
        << "</td><td class=\"note\">" << EscapeHtml(number.note) << "</td></tr>\n";
  }
  out << "</table>\n";
}

// The numbers that are no tiles.
void WriteLongNumbers(const ReportData& data, std::ostream& out) {
  std::vector<ReportNumber> numbers;
  for (const ReportNumber& number : data.numbers) {
    if (!IsTile(number)) numbers.push_back(number);
  }
  WriteFacts(numbers, out);
}

void WriteSelfCalibration(const ReportData& data, std::ostream& out) {
  if (data.self_calibration.empty()) return;
  out << "<h2>Self-calibration</h2>\n";
  WriteFacts(data.self_calibration, out);
}

// Entries for the statuses that occur.
std::vector<LegendEntry> StatusLegend(const ReportData& data) {
  std::vector<LegendEntry> legend;
  for (const ReportStatus status : kAllStatuses) {
    const bool occurs =
        std::any_of(data.frames.begin(), data.frames.end(),
                    [status](const ReportFrame& frame) { return frame.status == status; });
    if (!occurs) continue;
    legend.push_back({Swatch::kFill, std::string("status-") + ToString(status), ToString(status)});
  }
  return legend;
}

// Entries for the Manhattan axes that map lines have.
std::vector<LegendEntry> LineLegend(const ReportData& data) {
  std::vector<LegendEntry> legend;
  for (int axis = -1; axis < 3; ++axis) {
    const auto has_axis = [axis](const ReportLine& line) { return line.axis == axis; };
    if (std::none_of(data.map.lines.begin(), data.map.lines.end(), has_axis)) continue;
    legend.push_back({Swatch::kCurve, LineClass(axis),
                      axis < 0 ? "map lines without axis"
                               : "map lines along Manhattan axis " + std::to_string(axis + 1)});
  }
  return legend;
}

// Entries for the paths: as many for the estimate as it has submaps.
std::vector<LegendEntry> PathLegend(const ReportData& data) {
  std::vector<LegendEntry> legend;
  const std::vector<SubMapStart> submaps = FindSubMaps(data.frames);
  for (size_t i = 0; i < submaps.size(); ++i) {
    const std::string name = "submap " + std::to_string(submaps[i].number) + ", from frame " +
                             std::to_string(submaps[i].first_frame);
    legend.push_back({Swatch::kCurve, SubMapClass(i), submaps.size() > 1 ? name : "estimate"});
  }
  if (!data.odometry.empty()) {
    legend.push_back({Swatch::kCurve, "curve odometry", "before loops were closed"});
  }
  if (!data.ground_truth.empty()) {
    legend.push_back({Swatch::kCurve, "curve ground-truth", data.truth_name});
  }
  for (size_t i = 0; i < data.map.sessions.size(); ++i) {
    const std::string& name = data.map.sessions[i].name;
    legend.push_back({Swatch::kCurve, SessionClass(i),
                      name.empty() ? "earlier sessions" : "earlier session: " + name});
  }
  if (data.found_frame) legend.push_back({Swatch::kFill, "found", DescribeFound(data)});
  return legend;
}

void Append(const std::vector<LegendEntry>& more, std::vector<LegendEntry>* legend) {
  legend->insert(legend->end(), more.begin(), more.end());
}

void WriteTrajectory(const ReportData& data, std::ostream& out) {
  const TrajectoryView view = ChooseTrajectoryView(data);
  std::vector<LegendEntry> legend = PathLegend(data);
  for (const LegendEntry& status : StatusLegend(data)) {
    if (status.label == ToString(ReportStatus::kPredicted) ||
        status.label == ToString(ReportStatus::kLost)) {
      legend.push_back(status);
    }
  }
  std::vector<LegendEntry> top_legend = legend;
  Append(LineLegend(data), &top_legend);
  out << "<h2>Trajectory</h2>\n<p>Up is "
      << (view.up_from_cameras ? "the mean up direction of the camera"
                               : "the direction in which the trajectory extends least, as the "
                                 "camera has no common up direction")
      << "; right is the dominant horizontal direction of the trajectory. The circle marks the "
         "start, dots mark keyframes; frames without an estimated pose have the colour of their "
         "status.</p>\n<div class=\"views\">\n";
  WriteFigure(PlotTrajectory(data, view, TrajectorySide::kTop), top_legend, out, "data-zoom",
              "Top view");
  WriteFigure(PlotTrajectory(data, view, TrajectorySide::kSide), legend, out, "data-zoom",
              "Side view");
  out << "</div>\n";
}

void WriteSeries(const ReportData& data, std::ostream& out) {
  const std::vector<LegendEntry> statuses = StatusLegend(data);
  if (!data.ground_truth.empty()) {
    out << "<h2>Position error over time</h2>\n";
    std::vector<LegendEntry> legend = {{Swatch::kCurve, "curve error", "position error"}};
    Append(statuses, &legend);
    WriteFigure("", legend, out, "data-chart=\"error\"");
  }
  out << "<h2>Inliers and status over time</h2>\n";
  std::vector<LegendEntry> legend = {{Swatch::kCurve, "curve points", "inlier points"},
                                     {Swatch::kCurve, "curve lines", "inlier lines"}};
  Append(statuses, &legend);
  WriteFigure("", legend, out, "data-chart=\"inliers\"");
}

void WriteNotTracked(const ReportData& data, std::ostream& out) {
  const std::vector<NotTrackedSpan> spans = FindNotTrackedSpans(data.frames);
  out << "<h2>Frames without an estimated pose</h2>\n";
  if (spans.empty()) {
    out << "<p>None.</p>\n";
    return;
  }
  out << "<table>\n<tr><th>frames</th><th>from, s</th><th>to, s</th><th>predicted</th>"
         "<th>lost</th></tr>\n";
  const double start = data.frames.front().timestamp;
  for (const NotTrackedSpan& span : spans) {
    const int count = span.last_frame - span.first_frame + 1;
    out << "<tr><td>" << std::to_string(span.first_frame) << " to "
        << std::to_string(span.last_frame) << "</td><td>" << FormatFixed(span.start - start, 2)
        << "</td><td>" << FormatFixed(span.end - start, 2) << "</td><td>"
        << std::to_string(count - span.num_lost) << "</td><td>" << std::to_string(span.num_lost)
        << "</td></tr>\n";
  }
  out << "</table>\n";
}

void WriteTimes(const ReportData& data, std::ostream& out) {
  out << "<h2>Time per frame</h2>\n";
  std::vector<LegendEntry> legend;
  for (const ReportStage& stage : data.stages) {
    if (!stage.is_stacked) continue;
    legend.push_back({Swatch::kFill, "stage-" + std::to_string(legend.size() % 6), stage.name});
  }
  legend.push_back({Swatch::kCurve, "curve whole", "tracking, total"});
  WriteFigure("", legend, out, "data-chart=\"stages\"");
  out << "<h2>Time per keyframe</h2>\n";
  WriteFigure("", {{Swatch::kFill, "fill-mapping", "keyframe step of the mapper"}}, out,
              "data-chart=\"mapping\"");
  out << "<h2>Stages</h2>\n<table>\n<tr><th>milliseconds</th><th>mean</th><th>median</th>"
         "<th>95 %</th><th>max</th><th>times</th></tr>\n";
  for (const StageTimeStatistics& stage : SummarizeStages(data.stages, data.frames)) {
    out << "<tr><td>" << EscapeHtml(stage.name) << "</td><td>" << FormatFixed(stage.mean, 2)
        << "</td><td>" << FormatFixed(stage.median, 2) << "</td><td>" << FormatFixed(stage.p95, 2)
        << "</td><td>" << FormatFixed(stage.max, 2) << "</td><td>" << std::to_string(stage.count)
        << "</td></tr>\n";
  }
  out << "</table>\n";
}

void WriteFooter(const ReportData& data, std::ostream& out) {
  out << "<h2>Options</h2>\n<details><summary>All options in effect (YAML)</summary>\n<pre>"
      << EscapeHtml(data.options_text) << "</pre></details>\n<footer>" << EscapeHtml(data.version)
      << "</footer>\n";
}

}  // namespace

void WriteReport(const ReportData& data, std::ostream& out) {
  CheckStages(data);
  WriteHeader(data, out);
  WriteTiles(data, out);
  WriteViewerElements(out);
  WriteLongNumbers(data, out);
  if (data.frames.empty()) {
    out << "<p>No frame was processed.</p>\n";
  } else {
    WriteTrajectory(data, out);
    WriteSeries(data, out);
    WriteNotTracked(data, out);
    WriteTimes(data, out);
  }
  WriteSelfCalibration(data, out);
  WriteFooter(data, out);
  WriteViewerScripts(FormatRunJson(data), out);
  out << "</body>\n</html>\n";
}

}  // namespace msc_vo
