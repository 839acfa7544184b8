// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/results/benchmark.h"
#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/results/online_results.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> sequences;
  SequenceArguments layout;  // without the directory
  ConfigurationArguments configuration;
  RunArguments run;
  std::vector<std::string> modes;
  std::string output = "out/benchmark";
};

// The implemented modes: those that are valid with the default options.
std::vector<std::string> ImplementedModes() {
  std::vector<std::string> modes;
  for (const std::string& mode : OptionChoices("mode")) {
    std::string error;
    if (MakeConfiguration({"", {"mode=" + mode}}).odometry.IsValid(&error)) modes.push_back(mode);
  }
  return modes;
}

std::vector<std::string> WithoutRepeats(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  for (const std::string& name : names) {
    if (std::find(unique.begin(), unique.end(), name) == unique.end()) unique.push_back(name);
  }
  return unique;
}

// One for each mode. Throws std::runtime_error on invalid options.
std::vector<Configuration> MakeConfigurations(const Arguments& arguments,
                                              const std::vector<std::string>& modes) {
  std::vector<Configuration> configurations;
  for (const std::string& mode : modes) {
    ConfigurationArguments with_mode = arguments.configuration;
    with_mode.settings.push_back("mode=" + mode);
    configurations.push_back(MakeConfiguration(with_mode));
    PrintWarnings(DescribeIgnoredOptions(with_mode, configurations.back()));
    std::string error;
    if (!configurations.back().odometry.IsValid(&error)) throw std::runtime_error(error);
  }
  return configurations;
}

// Unique names of the results: folders with the same name get a number.
std::vector<std::string> UniqueNames(const std::vector<std::string>& directories) {
  std::vector<std::string> names;
  for (const std::string& directory : directories) {
    const std::string name = SequenceName(directory);
    std::string unique = name;
    for (int i = 2; std::find(names.begin(), names.end(), unique) != names.end(); ++i) {
      unique = name + "-" + std::to_string(i);
    }
    names.push_back(unique);
  }
  return names;
}

Benchmark Describe(const Arguments& arguments, const std::vector<std::string>& modes) {
  Benchmark benchmark;
  benchmark.command_line = CommandLine();
  benchmark.build = MSC_VO_BUILD;
  benchmark.num_processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  Configuration configuration = MakeConfiguration(arguments.configuration);
  configuration.odometry.mode = OdometryOptions().mode;  // set by every run
  benchmark.changed_options = ChangedOptions(configuration);
  benchmark.modes = modes;
  return benchmark;
}

// Runs one sequence in one mode and writes its files. `row` gets the measurements, also if the run
// fails, which is an exception.
void RunMode(const Arguments& arguments, const RgbdDecoder& decoder,
             const Configuration& configuration, const InterruptGuard& interrupt,
             BenchmarkRun* row) {
  const std::string folder = (fs::path(arguments.output) / row->sequence / row->mode).string();
  RefuseToOverwriteInputs(decoder.index(), arguments.configuration.config, folder);
  OnlineResults online(folder);
  const SequenceRun run =
      RunSequence(decoder, configuration, arguments.run, interrupt,
                  {[&](const FrameResult& frame) { online.Add(frame); }, {}, {}});
  row->summary = run.summary;
  row->cost = run.context.cost;
  row->error = run.context.error;
  if (run.HasImages()) WriteResultFiles(folder, run.result, run.context);
  if (run.exit_code != kExitSuccess) throw std::runtime_error(run.context.outcome);
  if (!row->error->usable) throw std::runtime_error("no errors: " + row->error->message);
}

void WriteTables(const std::string& directory, const Benchmark& benchmark) {
  MakeFolder(directory);
  const fs::path folder = directory;
  WriteFile((folder / "benchmark.md").string(), FormatBenchmarkMarkdown(benchmark));
  WriteFile((folder / "benchmark.json").string(), FormatBenchmarkJson(benchmark));
}

// Throws std::runtime_error if the sequence has no ground truth.
RgbdDecoder OpenWithGroundTruth(const SequenceArguments& sequence,
                                const Configuration& configuration) {
  RgbdDecoder decoder = OpenDecoder(sequence, configuration);
  PrintWarnings(decoder.index().warnings);
  if (!decoder.index().ground_truth.empty()) return decoder;
  throw std::runtime_error(decoder.index().directory +
                           ": no ground truth (groundtruth.txt or the file of the layout); add it, "
                           "or use msc_vo replay");
}

void PrintFailure(const std::string& run, const std::string& reason) {
  PrintError(run + " failed: " + reason);
}

// Runs every mode on one sequence. Writes the tables after each run.
void RunModes(const Arguments& arguments, const std::string& directory, const std::string& name,
              const std::vector<Configuration>& configurations, const InterruptGuard& interrupt,
              Benchmark* benchmark) {
  std::optional<RgbdDecoder> decoder;
  std::string failure;
  try {
    SequenceArguments sequence = arguments.layout;
    sequence.directory = directory;
    decoder.emplace(
        OpenWithGroundTruth(sequence, configurations.front()));  // modes share the camera
  } catch (const std::exception& error) {
    failure = error.what();
    PrintFailure(name, failure);
  }
  for (size_t i = 0; i < configurations.size() && !interrupt.IsInterrupted(); ++i) {
    BenchmarkRun row;
    row.sequence = name;
    row.mode = benchmark->modes[i];
    row.failure = failure;
    if (decoder) {
      if (!arguments.run.quiet) std::cerr << name << ", " << row.mode << ":" << std::endl;
      try {
        RunMode(arguments, *decoder, configurations[i], interrupt, &row);
      } catch (const std::exception& error) {
        row.failure = error.what();
        PrintFailure(name + ", " + row.mode, row.failure);
      }
    }
    benchmark->runs.push_back(std::move(row));
    WriteTables(arguments.output, *benchmark);
  }
}

int RunBenchmark(const Arguments& arguments) {
  const std::vector<std::string> modes =
      arguments.modes.empty() ? ImplementedModes() : WithoutRepeats(arguments.modes);
  const std::vector<Configuration> configurations = MakeConfigurations(arguments, modes);
  const std::vector<std::string> names = UniqueNames(arguments.sequences);
  Benchmark benchmark = Describe(arguments, modes);
  const InterruptGuard interrupt;
  RefuseToOverwrite(arguments.sequences, arguments.output);
  WriteTables(arguments.output, benchmark);  // fails early if the folder is not writable
  for (size_t i = 0; i < names.size() && !interrupt.IsInterrupted(); ++i) {
    RunModes(arguments, arguments.sequences[i], names[i], configurations, interrupt, &benchmark);
  }
  if (!arguments.run.quiet) std::cout << FormatBenchmarkMarkdown(benchmark) << std::flush;
  if (interrupt.IsInterrupted()) return kExitInterrupted;
  const auto num_failed =
      std::count_if(benchmark.runs.begin(), benchmark.runs.end(),
                    [](const BenchmarkRun& run) { return !run.failure.empty(); });
  if (num_failed == 0) return kExitSuccess;
  throw std::runtime_error(std::to_string(num_failed) + " of " +
                           std::to_string(benchmark.runs.size()) + " runs failed, see " +
                           (fs::path(arguments.output) / "benchmark.md").string());
}

}  // namespace

Command AddBenchmarkCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "benchmark", "Replay sequences in several modes and compare them with the ground truth");
  command
      ->add_option("sequences", arguments->sequences,
                   "Folders with RGB-D sequences with ground truth")
      ->required();
  AddLayoutArguments(command, &arguments->layout);
  AddConfigurationArguments(command, &arguments->configuration);
  command->add_option("--modes", arguments->modes, "Comma-separated list; default: all modes")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(OptionChoices("mode")));
  command
      ->add_option("--output", arguments->output,
                   "Folder for benchmark.md, benchmark.json and the results in <sequence>/<mode>/")
      ->capture_default_str();
  AddRunArguments(command, &arguments->run);
  command->footer(
      HelpFooter("msc_vo benchmark data/living data/corridor --modes pl-vo,pl-vo-depth"));
  return {command, [arguments] { return RunBenchmark(*arguments); }};
}

}  // namespace msc_vo
