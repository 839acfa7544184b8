// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark_json.h"

#include <filesystem>
#include <stdexcept>

#include "msc_vo/results/internal/run_json.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

// The measurements of a run that the tables show.
void ReadMeasurements(const Json& json, BenchmarkRun* run) {
  RunSummary& summary = run->summary;
  const Json& frames = json.at("frames");
  summary.num_frames = frames.at("count");
  for (size_t i = 0; i < summary.status_counts.size(); ++i) {
    summary.status_counts[i] = frames.at(ToString(static_cast<TrackingStatus>(i)));
  }
  summary.num_keyframes = json.at("map").at("keyframes");
  for (const auto& [name, stage] : json.at("stages_ms").items()) {
    summary.stages.push_back({name, stage.at("count"), stage.at("mean"), stage.at("median"),
                              stage.at("p95"), stage.at("max")});
  }
  run->cost = {json.at("wall_seconds"), json.at("processor_seconds"), json.at("peak_memory_mib")};
  const Json& error = json.at("error");
  if (error.is_null() || !error.at("usable").get<bool>()) return;
  run->error.emplace();
  run->error->usable = true;
  run->error->ape.count = error.at("matched");
  run->error->ape.rmse = error.at("ape_rmse");
  ErrorStatistics& rpe = run->error->rpe_per_second.translation;
  rpe.count = error.at("rpe_pairs");
  if (rpe.count > 0) rpe.rmse = error.at("rpe_1s");
}

BenchmarkRun ReadRun(const Json& json, const std::filesystem::path& folder) {
  BenchmarkRun run;
  run.sequence = json.at("sequence");
  run.sequence_index = json.at("sequence_index");
  run.directory = json.at("directory");
  run.mode = json.at("mode");
  run.folder = (folder / run.sequence / run.mode).string();
  if (!json.at("failure").is_null()) run.failure = json.at("failure");
  ReadMeasurements(json, &run);
  if (run.failure.empty() && !run.error) throw std::runtime_error("a run has no errors");
  Json measurements = json;
  for (const char* key : {"sequence", "sequence_index", "directory", "mode", "failure"}) {
    measurements.erase(key);
  }
  run.recorded = measurements.dump();
  return run;
}

}  // namespace

std::string FormatBenchmarkJson(const Benchmark& benchmark) {
  Json json;
  json["version"] = kVersion;
  json["command_line"] = benchmark.command_line;
  json["build"] = benchmark.build;
  json["processors"] = benchmark.num_processors;
  json["max_frames"] = benchmark.max_frames;
  json["mask"] = benchmark.mask.empty() ? Json() : Json(benchmark.mask);
  json["mask_zero"] = benchmark.mask_zero;
  json["changed_options"] = Json::object();
  for (const OptionText& option : benchmark.changed_options) {
    json["changed_options"][option.path] = option.value;
  }
  json["modes"] = benchmark.modes;
  json["runs"] = Json::array();
  for (const BenchmarkRun& run : benchmark.runs) {
    Json entry = {{"sequence", run.sequence},
                  {"sequence_index", run.sequence_index},
                  {"directory", run.directory},
                  {"mode", run.mode}};
    entry["failure"] = run.failure.empty() ? Json() : Json(run.failure);
    entry.update(run.recorded.empty() ? MeasurementsToJson(run.summary, run.error, run.cost)
                                      : Json::parse(run.recorded));
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

Benchmark ReadBenchmarkJson(const std::string& path) {
  Benchmark benchmark;
  try {
    const Json json = Json::parse(ReadText(path));
    if (json.at("version") != kVersion) {
      throw std::runtime_error("written by msc_vo " + json.at("version").get<std::string>() +
                               ", this is " + kVersion);
    }
    benchmark.command_line = json.at("command_line");
    benchmark.build = json.at("build");
    benchmark.num_processors = json.at("processors");
    benchmark.max_frames = json.at("max_frames");
    if (!json.at("mask").is_null()) json.at("mask").get_to(benchmark.mask);
    json.at("mask_zero").get_to(benchmark.mask_zero);
    for (const auto& [name, value] : json.at("changed_options").items()) {
      benchmark.changed_options.push_back({name, value});
    }
    benchmark.modes = json.at("modes").get<std::vector<std::string>>();
    for (const Json& run : json.at("runs")) {
      benchmark.runs.push_back(ReadRun(run, std::filesystem::path(path).parent_path()));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path +
                             ": cannot be read as results of msc_vo benchmark: " + error.what());
  }
  return benchmark;
}

}  // namespace msc_vo
