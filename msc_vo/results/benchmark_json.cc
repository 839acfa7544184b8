// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark_json.h"

#include "msc_vo/results/internal/run_json.h"
#include "msc_vo/version.h"

namespace msc_vo {

std::string FormatBenchmarkJson(const Benchmark& benchmark) {
  Json json;
  json["version"] = kVersion;
  json["command_line"] = benchmark.command_line;
  json["build"] = benchmark.build;
  json["processors"] = benchmark.num_processors;
  json["changed_options"] = Json::object();
  for (const OptionText& option : benchmark.changed_options) {
    json["changed_options"][option.path] = option.value;
  }
  json["modes"] = benchmark.modes;
  json["runs"] = Json::array();
  for (const BenchmarkRun& run : benchmark.runs) {
    Json entry = {{"sequence", run.sequence}, {"mode", run.mode}};
    entry["failure"] = run.failure.empty() ? Json() : Json(run.failure);
    entry.update(MeasurementsToJson(run.summary, run.error, run.cost));
    json["runs"].push_back(entry);
  }
  const MeanError mean = GeometricMean(benchmark);
  json["geometric_mean"] = {{"sequences", mean.num_sequences}, {"ape_rmse", Json::object()}};
  for (size_t i = 0; i < benchmark.modes.size(); ++i) {
    json["geometric_mean"]["ape_rmse"][benchmark.modes[i]] =
        ValueOrNull(mean.num_sequences, mean.ape[i]);
  }
  return FormatJson(json);
}

}  // namespace msc_vo
