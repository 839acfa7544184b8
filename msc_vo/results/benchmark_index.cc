// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark_index.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "msc_vo/report/html_text.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// A path as a relative URL.
std::string Url(const std::string& path) {
  std::string url;
  for (const char c : path) {
    const bool is_plain = IsLetterOrDigit(c) || c == '/' || c == '-' || c == '_' || c == '.';
    url += is_plain ? std::string(1, c) : FormatText("%%%02X", static_cast<unsigned char>(c));
  }
  return url;
}

// The report of a run as seen from the folder; empty if it has none.
std::string ReportUrl(const BenchmarkRun& run, const std::string& folder) {
  if (run.folder.empty()) return "";
  const fs::path report = fs::path(run.folder) / "report.html";
  std::error_code error;
  if (!HasEntry(report.string())) return "";
  const fs::path relative = fs::relative(report, folder, error);
  return error || relative.empty() ? "" : Url(relative.generic_string());
}

std::string RunCell(const BenchmarkRun* run, const std::string& folder) {
  if (!run) return "<td>not run</td>";
  const bool failed = !run->failure.empty();
  std::string text = failed ? "failed" : FormatText("%.2f", 1000.0 * run->error->ape.rmse);
  const std::string url = ReportUrl(*run, folder);
  if (!url.empty()) text = "<a href=\"" + url + "\">" + text + "</a>";
  const std::string title = failed ? " title=\"" + EscapeHtml(run->failure) + "\"" : "";
  return "<td" + title + ">" + text + "</td>";
}

std::string FormatRows(const Benchmark& benchmark, const std::string& folder) {
  std::string rows = "<tr><th>APE RMSE, mm</th>";
  for (const std::string& mode : benchmark.modes) rows += "<th>" + EscapeHtml(mode) + "</th>";
  rows += "<th>frames</th></tr>\n";
  for (const std::string& sequence : SequenceNames(benchmark)) {
    rows += "<tr><td>" + EscapeHtml(sequence) + "</td>";
    int num_frames = 0;
    for (const std::string& mode : benchmark.modes) {
      const BenchmarkRun* const run = FindRun(benchmark, sequence, mode);
      rows += RunCell(run, folder);
      if (run) num_frames = std::max(num_frames, run->summary.num_frames);
    }
    rows += "<td>" + std::to_string(num_frames) + "</td></tr>\n";
  }
  const MeanError mean = GeometricMean(benchmark);
  if (mean.num_sequences == 0) return rows;
  rows += FormatText("<tr><th>geometric mean of %d</th>", mean.num_sequences);
  for (const double ape : mean.ape) rows += FormatText("<td>%.2f</td>", 1000.0 * ape);
  return rows + "<td></td></tr>\n";
}

std::string FormatFailureList(const Benchmark& benchmark) {
  std::string items;
  for (const BenchmarkRun& run : benchmark.runs) {
    if (run.failure.empty()) continue;
    items += "<li>" + EscapeHtml(run.sequence + ", " + run.mode + ": " + run.failure) + "</li>\n";
  }
  return items.empty() ? "" : "<h2>Failed runs</h2>\n<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string FormatBenchmarkIndex(const Benchmark& benchmark, const std::string& folder) {
  std::string html = PageHead("msc_vo benchmark") + "<p><code>" +
                     EscapeHtml(benchmark.command_line) + "</code></p>\n<p>msc_vo " + kVersion +
                     ", " + EscapeHtml(benchmark.build) + "; options other than the defaults:";
  for (const OptionText& option : benchmark.changed_options) {
    html += " <code>" + EscapeHtml(option.path + "=" + option.value) + "</code>";
  }
  html += benchmark.changed_options.empty() ? " none" : "";
  html +=
      ".</p>\n<h2>Position error after alignment</h2>\n<p>Each number links to the report of its "
      "run.</p>\n<table>\n" +
      FormatRows(benchmark, folder) + "</table>\n" + FormatFailureList(benchmark);
  return html + "</body>\n</html>\n";
}

}  // namespace msc_vo
