// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "apps/cli/benchmark_runner.h"
#include "apps/cli/benchmark_sequences.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/results/benchmark.h"
#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/results/benchmark_merge.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

struct BenchmarkArguments {
  std::vector<std::string> sequences;
  SequenceArguments layout;  // without the directory
  ConfigurationArguments configuration;
  RunArguments run;
  std::vector<std::string> modes;
  std::string output = "out/benchmark";
  bool overwrite = false;
  std::string shard;               // "K/N"; empty: all
  std::vector<std::string> merge;  // folders; empty: run
  bool resume = false;
  std::string root;  // of the sequences of a table of the literature
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
std::vector<Configuration> MakeConfigurations(const BenchmarkArguments& arguments,
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

Benchmark Describe(const BenchmarkArguments& arguments, const std::vector<std::string>& modes) {
  Benchmark benchmark;
  benchmark.command_line = CommandLine();
  benchmark.build = MSC_VO_BUILD;
  benchmark.num_processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  Configuration configuration = MakeConfiguration(arguments.configuration);
  configuration.odometry.mode = OdometryOptions().mode;  // set by every run
  benchmark.changed_options = ChangedOptions(configuration);
  benchmark.modes = modes;
  benchmark.max_frames = arguments.run.max_frames;
  benchmark.mask = arguments.layout.mask;
  benchmark.mask_zero = arguments.layout.mask_zero;
  return benchmark;
}

// Prints the tables. Returns the exit code; throws std::runtime_error if a run failed.
int Report(const BenchmarkArguments& arguments, const Shard& shard, const Benchmark& benchmark,
           bool is_interrupted) {
  if (arguments.run.json) {
    std::cout << FormatBenchmarkJson(benchmark) << std::flush;
  } else if (!arguments.run.quiet) {
    std::cout << FormatBenchmarkMarkdown(benchmark) << std::flush;
  }
  if (is_interrupted) {
    PrintWarning("interrupted; finished runs are in " + arguments.output +
                 ", and the same command with --resume continues");
    return kExitInterrupted;
  }
  const auto num_failed =
      std::count_if(benchmark.runs.begin(), benchmark.runs.end(),
                    [](const BenchmarkRun& run) { return !run.failure.empty(); });
  if (num_failed == 0) return kExitSuccess;
  const std::string table = ShardFileName("benchmark", shard, ".md");
  throw std::runtime_error(std::to_string(num_failed) + " of " +
                           std::to_string(benchmark.runs.size()) + " runs failed, see " +
                           PathIn(arguments.output, table));
}

// Runs the sequences of a table of the literature with loop closing off and on.
int RunPublished(const BenchmarkArguments& arguments) {
  const std::string& path = arguments.sequences.front();
  if (arguments.sequences.size() != 1) {
    throw UsageError(path + ": a table of the literature is given alone");
  }
  if (arguments.root.empty()) {
    throw UsageError(path + ": give the folder of the datasets with --root");
  }
  if (!arguments.modes.empty() || !arguments.shard.empty()) {
    throw UsageError(path +
                     ": a table of the literature is run in the mode msc-vo, in one "
                     "share; leave out --modes and --shard");
  }
  const PublishedTable table = ReadPublishedTable(path);
  BenchmarkPlan plan;
  for (const char* loops : {"close_loops=false", "close_loops=true"}) {
    ConfigurationArguments with_loops = arguments.configuration;
    with_loops.settings.push_back(loops);
    plan.configurations.push_back(MakeConfiguration(with_loops));
  }
  plan.sequences = FindPublishedSequences(table, path, arguments.root);
  plan.layout = arguments.layout;
  plan.run = arguments.run;
  plan.input_files = arguments.configuration.InputFiles();
  plan.output = arguments.output;
  plan.overwrite = arguments.overwrite;
  RefuseToOverwrite({path, arguments.root}, arguments.output);
  Benchmark benchmark = Describe(arguments, {"loops-off", "loops-on"});
  const InterruptGuard interrupt;
  BenchmarkRunner runner(plan, interrupt, &benchmark);
  if (arguments.resume) runner.Resume();
  const std::string problem = runner.Run();
  if (!problem.empty()) throw std::runtime_error(problem);
  WritePublishedTables(table, benchmark, arguments.root, arguments.output);
  if (arguments.run.json) {
    std::cout << FormatPublishedJson(table, benchmark, arguments.root) << std::flush;
  } else if (!arguments.run.quiet) {
    std::cout << FormatPublishedMarkdown(table, benchmark, arguments.root) << std::flush;
  }
  BenchmarkArguments silent = arguments;
  silent.run.json = false;
  silent.run.quiet = true;
  return Report(silent, plan.shard, benchmark, interrupt.IsInterrupted());
}

int RunBenchmark(const BenchmarkArguments& arguments) {
  if (IsPublishedTable(arguments.sequences)) return RunPublished(arguments);
  if (!arguments.root.empty()) {
    throw UsageError("--root belongs to a table of the literature (.yaml)");
  }
  const std::vector<std::string> modes =
      arguments.modes.empty() ? ImplementedModes() : WithoutRepeats(arguments.modes);
  BenchmarkPlan plan;
  plan.configurations = MakeConfigurations(arguments, modes);
  if (!arguments.shard.empty()) plan.shard = ParseShardArgument(arguments.shard);
  plan.sequences = ShareOf(ListBenchmarkSequences(arguments.sequences), plan.shard);
  plan.layout = arguments.layout;
  plan.run = arguments.run;
  plan.input_files = arguments.configuration.InputFiles();
  plan.output = arguments.output;
  plan.overwrite = arguments.overwrite;
  std::vector<std::string> inputs = arguments.sequences;
  for (const BenchmarkSequence& sequence : plan.sequences) inputs.push_back(sequence.directory);
  RefuseToOverwrite(inputs, arguments.output);

  Benchmark benchmark = Describe(arguments, modes);
  const InterruptGuard interrupt;
  BenchmarkRunner runner(plan, interrupt, &benchmark);
  if (arguments.resume) runner.Resume();
  const std::string problem = runner.Run();
  const int exit_code = Report(arguments, plan.shard, benchmark, interrupt.IsInterrupted());
  if (!problem.empty()) throw std::runtime_error(problem);
  return exit_code;
}

// Joins the tables of several shares.
int Merge(const BenchmarkArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& folder : arguments.merge) {
    const std::vector<std::string> found = FindBenchmarkFiles(folder);
    if (found.empty()) {
      throw std::runtime_error(folder + ": no results of msc_vo benchmark (benchmark*.json)");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  // The result of an earlier merge is not its own input.
  const auto is_output = [&](const std::string& file) {
    std::error_code error;
    return fs::path(file).filename() == "benchmark.json" && files.size() > 1 &&
           fs::equivalent(fs::path(file).parent_path(), arguments.output, error);
  };
  EraseIf(&files, is_output);

  Benchmark benchmark = ReadBenchmarkJson(files.front());
  for (size_t i = 1; i < files.size(); ++i) {
    const Benchmark more = ReadBenchmarkJson(files[i]);
    const std::string difference = DescribeDifference(benchmark, more);
    if (!difference.empty()) {
      throw std::runtime_error(files[i] + ": cannot be merged with " + files.front() +
                               ", because the settings differ: " + difference);
    }
    AddRuns(more.runs, &benchmark);
  }
  SortRuns(&benchmark);
  benchmark.command_line = CommandLine();
  if (!arguments.overwrite) RefuseToReplaceTables(arguments.output, Shard());
  WriteBenchmarkTables(arguments.output, Shard(), benchmark);
  const std::vector<std::string> missing = MissingShards(files);
  for (const std::string& shard : missing) PrintWarning("shard " + shard + " is missing");
  const int exit_code = Report(arguments, Shard(), benchmark, false);
  if (missing.empty()) return exit_code;
  throw std::runtime_error(std::to_string(missing.size()) +
                           " shards are missing; the tables hold the "
                           "others");
}

}  // namespace

Command AddBenchmarkCommand(CLI::App* app) {
  const auto arguments = std::make_shared<BenchmarkArguments>();
  CLI::App* command = app->add_subcommand(
      "benchmark", "Replay sequences in several modes and compare them with the ground truth");
  CLI::Option* sequences =
      command->add_option("sequences", arguments->sequences,
                          "Sequences with ground truth, text files that list one per line, or a "
                          "table of the literature (.yaml)");
  command
      ->add_option("--merge", arguments->merge,
                   "Join the results in these folders instead of running anything")
      ->excludes(sequences);
  command
      ->add_option("--root", arguments->root,
                   "Folder with the datasets of a table of the literature")
      ->excludes("--merge");
  command
      ->add_option("--shard", arguments->shard,
                   "K/N: run only the K-th of N shares of the sequences")
      ->excludes("--merge");
  command
      ->add_flag("--resume", arguments->resume,
                 "Keep the finished runs in the output folder and run the others")
      ->excludes("--merge");
  AddLayoutArguments(command, &arguments->layout);
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->add_option("--modes", arguments->modes, "Comma-separated list; default: all modes")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(OptionChoices("mode")));
  command
      ->add_option("--output", arguments->output,
                   "Folder for benchmark.md, benchmark.json, index.html and the results in "
                   "<sequence>/<mode>/")
      ->capture_default_str();
  command->add_flag("--overwrite", arguments->overwrite,
                    "Write into a folder that holds the results of other sequences");
  AddRunArguments(command, &arguments->run);
  command->footer(
      HelpFooter("msc_vo benchmark data/living data/corridor --modes pl-vo,pl-vo-depth"));
  command->callback([arguments] {
    if (arguments->sequences.empty() && arguments->merge.empty()) {
      throw CLI::RequiredError("sequences");
    }
  });
  return {command, [arguments] {
            return arguments->merge.empty() ? RunBenchmark(*arguments) : Merge(*arguments);
          }};
}

}  // namespace msc_vo
