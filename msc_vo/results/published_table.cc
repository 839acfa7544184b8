// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/published_table.h"

#include <algorithm>

#include "msc_vo/report/html_text.h"
#include "msc_vo/results/internal/json_value.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

using Row = std::vector<std::string>;

constexpr char kNoResult[] = "-";

// The error of a run, metres; nullopt if it failed or was not run.
std::optional<double> ErrorOf(const BenchmarkRun* run) {
  if (run == nullptr || !run->failure.empty() || !run->error) return std::nullopt;
  return run->error->ape.rmse;
}

std::string RunCell(const BenchmarkRun* run) {
  if (run == nullptr) return kNoResult;
  const std::optional<double> error = ErrorOf(run);
  return error ? FormatText("%.1f", 1000.0 * *error) : "failed";
}

std::string PublishedCell(const PublishedSequence& sequence, const std::string& system) {
  const auto found = sequence.errors.find(system);
  if (found == sequence.errors.end()) return kNoResult;
  return found->second ? FormatText("%.1f", 1000.0 * *found->second) : "failed";
}

// Whether the sequence was found and run.
bool HasRun(const Benchmark& benchmark, const std::string& sequence) {
  return std::any_of(benchmark.runs.begin(), benchmark.runs.end(),
                     [&](const BenchmarkRun& run) { return run.sequence == sequence; });
}

// The cells of the table, with a head.
std::vector<Row> Cells(const PublishedTable& table, const Benchmark& benchmark) {
  std::vector<Row> rows = {{"APE RMSE, mm"}};
  for (const std::string& mode : benchmark.modes) rows[0].push_back("msc_vo, " + mode);
  for (const PublishedSystem& system : table.systems) rows[0].push_back(system.name);
  for (const PublishedSequence& sequence : table.sequences) {
    Row row = {sequence.name};
    for (const std::string& mode : benchmark.modes) {
      row.push_back(RunCell(FindRun(benchmark, sequence.name, mode)));
    }
    for (const PublishedSystem& system : table.systems) {
      row.push_back(PublishedCell(sequence, system.name));
    }
    rows.push_back(row);
  }
  return rows;
}

std::string Settings(const Benchmark& benchmark) {
  std::string text = "msc_vo " + std::string(kVersion) + "; options other than the defaults:";
  for (const OptionText& option : benchmark.changed_options) {
    text += " " + option.path + "=" + option.value;
  }
  if (benchmark.changed_options.empty()) text += " none";
  if (benchmark.max_frames > 0) {
    text += FormatText(
        "; only the first %d images of each sequence, which no published number is "
        "of",
        benchmark.max_frames);
  }
  return text + ".";
}

// Where the numbers come from.
std::string Origin(const PublishedTable& table) {
  const std::string own = "Columns of msc_vo were run by this command.";
  return table.systems.empty() ? own : own + " The others are published:";
}

std::string DescribeMissing(const PublishedSequence& sequence, const std::string& root) {
  return sequence.name + " (" + sequence.dataset + "): wanted as the folder " +
         Joined(sequence.folders, " or ") + " in " + root + "; it can be had from " + sequence.url;
}

}  // namespace

std::string FormatPublishedMarkdown(const PublishedTable& table, const Benchmark& benchmark,
                                    const std::string& root) {
  std::string text = "# " + table.title + "\n\n" + Settings(benchmark) + "\n\n";
  const std::vector<Row> rows = Cells(table, benchmark);
  for (size_t i = 0; i < rows.size(); ++i) {
    for (const std::string& cell : rows[i]) text += "| " + cell + " ";
    text += "|\n";
    if (i > 0) continue;
    for (size_t k = 0; k < rows[0].size(); ++k) text += k == 0 ? "|---" : "|--:";
    text += "|\n";
  }
  text += "\n" + Origin(table) + "\n\n";
  for (const PublishedSystem& system : table.systems) {
    text += "- " + system.name + ": " + system.source + "\n";
  }
  std::string missing;
  for (const PublishedSequence& sequence : table.sequences) {
    if (HasRun(benchmark, sequence.name)) continue;
    missing += "- " + DescribeMissing(sequence, root) + "\n";
  }
  return text + (missing.empty() ? "" : "\nNot run:\n\n" + missing);
}

std::string FormatPublishedHtml(const PublishedTable& table, const Benchmark& benchmark,
                                const std::string& root) {
  std::string html =
      PageHead(table.title) + "<p>" + EscapeHtml(Settings(benchmark)) + "</p>\n<table>\n";
  const std::vector<Row> rows = Cells(table, benchmark);
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::string tag = i == 0 ? "th" : "td";
    html += "<tr>";
    for (const std::string& cell : rows[i]) {
      html += "<" + tag + ">" + EscapeHtml(cell) + "</" + tag + ">";
    }
    html += "</tr>\n";
  }
  html += "</table>\n<p>" + Origin(table) + "</p>\n<ul>\n";
  for (const PublishedSystem& system : table.systems) {
    html += "<li>" + EscapeHtml(system.name + ": " + system.source) + "</li>\n";
  }
  html += "</ul>\n";
  std::string missing;
  for (const PublishedSequence& sequence : table.sequences) {
    if (HasRun(benchmark, sequence.name)) continue;
    missing += "<li>" + EscapeHtml(DescribeMissing(sequence, root)) + "</li>\n";
  }
  if (!missing.empty()) html += "<h2>Not run</h2>\n<ul>\n" + missing + "</ul>\n";
  return html + "</body>\n</html>\n";
}

std::string FormatPublishedJson(const PublishedTable& table, const Benchmark& benchmark,
                                const std::string& root) {
  Json json = {{"title", table.title}, {"version", kVersion}, {"root", root}};
  json["max_frames"] = benchmark.max_frames;
  json["systems"] = Json::array();
  for (const PublishedSystem& system : table.systems) {
    json["systems"].push_back({{"name", system.name}, {"source", system.source}});
  }
  json["sequences"] = Json::array();
  for (const PublishedSequence& sequence : table.sequences) {
    Json entry = {{"name", sequence.name}, {"dataset", sequence.dataset}, {"url", sequence.url}};
    entry["is_run"] = HasRun(benchmark, sequence.name);
    entry["msc_vo"] = Json::object();
    for (const std::string& mode : benchmark.modes) {
      const BenchmarkRun* const run = FindRun(benchmark, sequence.name, mode);
      if (run == nullptr) continue;
      const std::optional<double> error = ErrorOf(run);
      entry["msc_vo"][mode] = error ? Json(*error) : Json();
    }
    entry["published"] = Json::object();
    for (const auto& [system, error] : sequence.errors) {
      entry["published"][system] = error ? Json(*error) : Json();
    }
    json["sequences"].push_back(entry);
  }
  return FormatJson(json);
}

}  // namespace msc_vo
