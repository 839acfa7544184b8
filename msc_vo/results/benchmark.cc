// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/text/format_text.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

using Row = std::vector<std::string>;

// A Markdown table with aligned columns: the first one to the left, numbers to the right.
std::string FormatTable(const std::vector<Row>& rows) {
  std::vector<size_t> widths(rows.front().size(), 4);  // "---:" must fit
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string table;
  for (const Row& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - row[i].size(), ' ');
      table += "| " + (i == 0 ? row[i] + padding : padding + row[i]) + " ";
    }
    table += "|\n";
    if (&row != &rows.front()) continue;
    for (size_t i = 0; i < row.size(); ++i) {
      table += "| " + std::string(widths[i] - 1, '-') + (i == 0 ? "- " : ": ");
    }
    table += "|\n";
  }
  return table;
}

// Text that does not break the table: without '|', and only the first line.
std::string Cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return text.substr(0, text.find('\n'));
}

std::string Millimetres(double metres) { return FormatText("%.2f", 1000.0 * metres); }

std::string FormatHeader(const Benchmark& benchmark) {
  std::string text = "# msc_vo benchmark\n\n";
  text += "- version: msc_vo " + std::string(kVersion) + "\n";
  text += "- command: `" + benchmark.command_line + "`\n";
  text += "- build: " + benchmark.build + "\n";
  text += FormatText("- processors: %d\n", benchmark.num_processors);
  text += "- options other than the defaults:";
  for (const OptionText& option : benchmark.changed_options) {
    text += " `" + option.path + "=" + option.value + "`";
  }
  return text + (benchmark.changed_options.empty() ? " none\n" : "\n");
}

// Names the sequences on which a mode failed, which are excluded from the mean. Empty if none.
std::string DescribeExcluded(const Benchmark& benchmark) {
  std::string names;
  for (const std::string& sequence : SequenceNames(benchmark)) {
    const bool failed = std::any_of(
        benchmark.runs.begin(), benchmark.runs.end(),
        [&](const BenchmarkRun& run) { return run.sequence == sequence && !run.failure.empty(); });
    if (failed) names += (names.empty() ? "" : ", ") + Cell(sequence);
  }
  return names.empty() ? "" : "\nExcluded from the mean because a run failed: " + names + ".\n";
}

std::string FormatErrorTable(const Benchmark& benchmark) {
  std::vector<Row> rows = {{"APE RMSE, mm"}};
  rows[0].insert(rows[0].end(), benchmark.modes.begin(), benchmark.modes.end());
  for (const std::string& sequence : SequenceNames(benchmark)) {
    Row row = {Cell(sequence)};
    for (const std::string& mode : benchmark.modes) {
      const BenchmarkRun* run = FindRun(benchmark, sequence, mode);
      row.push_back(!run                   ? "not run"
                    : run->failure.empty() ? Millimetres(run->error->ape.rmse)
                                           : "failed");
    }
    rows.push_back(row);
  }
  const MeanError mean = GeometricMean(benchmark);
  if (mean.num_sequences > 0) {
    Row means = {FormatText("geometric mean of %d", mean.num_sequences)};
    Row ratios = {"ratio to " + benchmark.modes.front()};
    for (const double ape : mean.ape) {
      means.push_back(Millimetres(ape));
      ratios.push_back(FormatText("%.3f", ape / mean.ape.front()));
    }
    rows.push_back(means);
    if (benchmark.modes.size() > 1) rows.push_back(ratios);
  }
  return "## Position error after alignment\n\n" + FormatTable(rows) + DescribeExcluded(benchmark);
}

// Counts of all statuses but "tracked", which has its own column.
std::string OtherStatuses(const RunSummary& summary) {
  std::string text;
  for (size_t i = 1; i < summary.status_counts.size(); ++i) {
    if (summary.status_counts[i] == 0) continue;
    text += FormatText("%s%d %s", text.empty() ? "" : ", ", summary.status_counts[i],
                       ToString(static_cast<TrackingStatus>(i)));
  }
  return text;
}

Row RunRow(const BenchmarkRun& run) {
  const RunSummary& summary = run.summary;
  Row row = {Cell(run.sequence)};
  if (run.failure.empty()) {
    const ErrorStatistics& rpe = run.error->rpe_per_second.translation;
    row.push_back(Millimetres(run.error->ape.rmse));
    row.push_back(rpe.count > 0 ? Millimetres(rpe.rmse) : "-");
  } else {
    row.insert(row.end(), {"failed", "-"});
  }
  if (summary.num_frames == 0) {
    row.insert(row.end(), 9, "-");
    return row;
  }
  const StageTimeStatistics tracking = FindStage(summary, "tracking");
  const StageTimeStatistics mapping = FindStage(summary, "mapping");
  const int num_tracked = summary.Count(TrackingStatus::kTracked);
  row.push_back(std::to_string(summary.num_frames));
  row.push_back(FormatText("%.1f", 100.0 * num_tracked / summary.num_frames));
  row.push_back(OtherStatuses(summary));
  row.push_back(FormatText("%.1f", tracking.mean));
  row.push_back(FormatText("%.1f", tracking.p95));
  row.push_back(FormatText("%.1f", 1000.0 * run.cost.processor_seconds / summary.num_frames));
  row.push_back(FormatText("%.1f", mapping.mean));
  row.push_back(std::to_string(summary.num_keyframes));
  row.push_back(FormatText("%.0f", run.cost.peak_memory));
  return row;
}

std::string FormatModeTable(const Benchmark& benchmark, const std::string& mode) {
  std::vector<Row> rows = {{mode, "APE, mm", "RPE, mm/s", "frames", "tracked, %", "others",
                            "tracking, ms", "95 %, ms", "processor, ms", "mapping, ms", "keyframes",
                            "memory, MiB"}};
  for (const BenchmarkRun& run : benchmark.runs) {
    if (run.mode == mode) rows.push_back(RunRow(run));
  }
  if (rows.size() == 1) return "";  // interrupted before the first run in this mode
  return "\n## Mode " + mode + "\n\n" + FormatTable(rows);
}

std::string FormatFailures(const Benchmark& benchmark) {
  std::string text;
  for (const BenchmarkRun& run : benchmark.runs) {
    if (run.failure.empty()) continue;
    text += "- " + run.sequence + ", " + run.mode + ": " + Cell(run.failure) + "\n";
  }
  return text.empty() ? "" : "\n## Failed runs\n\n" + text;
}

constexpr char kLegend[] = R"(
APE: RMSE of the camera's position after rigid alignment with the ground truth. RPE: RMSE of the
motion over one second. tracked: frames with status "tracked"; others: frames with another status.
tracking and 95 %: wall time per frame from the decoded images to the pose, mean and 95 % quantile.
processor: processor time of the whole process per frame, decoding and mapping included.
mapping: wall time per keyframe. memory: peak resident memory.
)";

}  // namespace

std::vector<std::string> SequenceNames(const Benchmark& benchmark) {
  std::vector<std::string> names;
  for (const BenchmarkRun& run : benchmark.runs) {
    if (std::find(names.begin(), names.end(), run.sequence) == names.end()) {
      names.push_back(run.sequence);
    }
  }
  return names;
}

const BenchmarkRun* FindRun(const Benchmark& benchmark, const std::string& sequence,
                            const std::string& mode) {
  for (const BenchmarkRun& run : benchmark.runs) {
    if (run.sequence == sequence && run.mode == mode) return &run;
  }
  return nullptr;
}

MeanError GeometricMean(const Benchmark& benchmark) {
  MeanError mean;
  std::vector<double> log_sums(benchmark.modes.size(), 0.0);
  for (const std::string& sequence : SequenceNames(benchmark)) {
    std::vector<double> logs;
    for (const std::string& mode : benchmark.modes) {
      const BenchmarkRun* run = FindRun(benchmark, sequence, mode);
      if (run && run->failure.empty()) logs.push_back(std::log(run->error->ape.rmse));
    }
    if (logs.size() < benchmark.modes.size()) continue;
    ++mean.num_sequences;
    for (size_t i = 0; i < logs.size(); ++i) log_sums[i] += logs[i];
  }
  for (const double sum : log_sums) {
    mean.ape.push_back(mean.num_sequences > 0 ? std::exp(sum / mean.num_sequences)
                                              : std::numeric_limits<double>::quiet_NaN());
  }
  return mean;
}

std::string FormatBenchmarkMarkdown(const Benchmark& benchmark) {
  std::string text = FormatHeader(benchmark) + "\n" + FormatErrorTable(benchmark);
  for (const std::string& mode : benchmark.modes) text += FormatModeTable(benchmark, mode);
  return text + FormatFailures(benchmark) + kLegend;
}

}  // namespace msc_vo
