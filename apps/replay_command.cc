// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <vector>

#include <sys/resource.h>

#include "apps/commands.h"
#include "apps/interrupt_guard.h"
#include "apps/progress.h"
#include "apps/run_report.h"
#include "apps/sequence_arguments.h"
#include "msc_vo/io/options_file.h"
#include "msc_vo/io/result_files.h"
#include "msc_vo/io/rgbd_source.h"
#include "msc_vo/io/text_file.h"
#include "msc_vo/io/trajectory.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

struct Arguments {
  SequenceArguments sequence;
  std::string output;
  std::string mode;
  std::string lines;
  std::vector<std::string> settings;  // "path=value"
  int max_frames = 0;                 // 0: all
  bool no_points = false;
  bool no_lines = false;
  bool quiet = false;
  bool print_config = false;
};

void SetByName(const std::string& path, const std::string& value, Configuration* configuration) {
  const std::vector<Option> options = ListOptions(configuration);
  const auto option = std::find_if(options.begin(), options.end(),
                                   [&](const Option& known) { return known.path == path; });
  if (option == options.end()) {
    const Option* similar = FindSimilar(options, path);
    throw std::runtime_error("--set: unknown option '" + path + "'" +
                             (similar ? "; did you mean '" + similar->path + "'?" : ""));
  }
  std::string expected;
  if (!SetOption(*option, value, &expected)) {
    throw std::runtime_error("--set: " + path + " must be " + expected + ", not '" + value + "'");
  }
}

// Defaults, then --config, then the other arguments.
Configuration MakeConfiguration(const Arguments& arguments) {
  Configuration configuration = LoadConfiguration(arguments.sequence);
  OdometryOptions& odometry = configuration.odometry;
  if (!arguments.mode.empty()) SetByName("mode", arguments.mode, &configuration);
  if (!arguments.lines.empty()) {
    SetByName("features.lines.detector", arguments.lines, &configuration);
  }
  if (arguments.no_points) odometry.use_points = false;
  if (arguments.no_lines) odometry.use_lines = false;
  for (const std::string& setting : arguments.settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw std::runtime_error("--set: expected NAME=VALUE, not '" + setting + "'");
    }
    SetByName(setting.substr(0, equals), setting.substr(equals + 1), &configuration);
    if (configuration.camera.origin.empty()) configuration.camera.origin = "--set";
  }
  return configuration;
}

// Peak resident memory of this process, MiB.
double PeakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts kilobytes
}

// How a run ended: it may have ended early, but what it found until then is worth keeping.
struct Run {
  OdometryResult result;
  std::string outcome = "complete";
  int exit_code = kExitSuccess;
  double seconds = 0.0;
};

Run RunOdometry(const RgbdDecoder& decoder, const OdometryOptions& options, int num_frames,
                bool quiet) {
  Run run;
  const Calibration& calibration = decoder.calibration();
  Odometry odometry(options, calibration.camera, calibration.distortion);
  RgbdSource source(decoder, 0, num_frames);
  const InterruptGuard interrupt;
  Progress progress(num_frames);
  int done = 0;
  try {
    for (RgbdImage image; !interrupt.IsInterrupted() && source.Next(&image);) {
      const FrameResult frame = odometry.Process(image);
      if (!quiet) progress.Update(++done, ToString(frame.status));
    }
  } catch (const std::exception& error) {
    run.outcome = error.what();
    run.exit_code = kExitError;
  }
  if (!quiet) progress.Finish();
  if (run.exit_code == kExitSuccess && interrupt.IsInterrupted()) {
    run.outcome = "interrupted";
    run.exit_code = kExitInterrupted;
  }
  run.result = odometry.Finish();
  run.seconds = progress.Seconds();
  return run;
}

std::string OutputDirectory(const Arguments& arguments, const SequenceIndex& index) {
  if (!arguments.output.empty()) return arguments.output;
  return (fs::path("out") / fs::path(index.directory).filename()).string();
}

void WriteOutput(const std::string& directory, const OdometryResult& result,
                 const RunSummary& summary, const RunContext& context) {
  WriteResultFiles(directory, result, context);
  const fs::path folder = directory;
  const std::vector<TimedPose>& truth = context.sequence.ground_truth;
  if (!truth.empty()) WriteTrajectory((folder / "groundtruth.txt").string(), truth);
  WriteFile((folder / "report.html").string(), FormatReport(result, summary, context));
}

int Replay(const Arguments& arguments) {
  const Configuration configuration = MakeConfiguration(arguments);
  if (arguments.print_config) {
    std::cout << FormatConfiguration(configuration);
    return kExitSuccess;
  }
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration);
  for (const std::string& warning : decoder.index().warnings) {
    std::cerr << "msc_vo: warning: " << warning << std::endl;
  }
  const int num_frames =
      arguments.max_frames > 0 ? std::min(arguments.max_frames, decoder.size()) : decoder.size();
  const Run run = RunOdometry(decoder, configuration.odometry, num_frames, arguments.quiet);
  if (run.result.frames.empty()) {
    if (run.exit_code == kExitError) throw std::runtime_error(run.outcome);
    return run.exit_code;
  }

  RunContext context;
  context.command_line = CommandLine();
  context.outcome = run.outcome;
  context.sequence = decoder.index();
  context.calibration = decoder.calibration();
  context.configuration = configuration;
  if (!context.sequence.ground_truth.empty()) {
    context.error = EvaluateTrajectory(context.sequence.ground_truth, TrajectoryOf(run.result));
  }
  context.seconds = run.seconds;
  context.peak_memory = PeakMemory();
  const RunSummary summary = Summarize(run.result);
  const std::string output = OutputDirectory(arguments, context.sequence);
  WriteOutput(output, run.result, summary, context);
  if (!arguments.quiet) PrintRunTable(summary, context, output);
  if (run.exit_code == kExitError) {
    throw std::runtime_error(run.outcome + "\n(what was computed until then is in " + output + ")");
  }
  return run.exit_code;
}

}  // namespace

Command AddReplayCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app->add_subcommand("replay", "Estimate the camera's trajectory from an RGB-D sequence");
  CLI::Option* sequence = AddSequenceArguments(command, &arguments->sequence);
  command->add_option("--output", arguments->output,
                      "Folder for the results; default: out/<name of the sequence>");
  command
      ->add_option("--mode", arguments->mode, "What of the method is used; default: the options'")
      ->check(CLI::IsMember({"msc-vo", "pl-vo-depth", "pl-vo"}));
  command->add_option("--lines", arguments->lines, "Line detector: the paper's, or a fast one")
      ->check(CLI::IsMember({"lsd", "edge-drawing"}));
  command->add_flag("--no-points", arguments->no_points, "Lines alone");
  command->add_flag("--no-lines", arguments->no_lines, "Points alone");
  command->add_option("--max-frames", arguments->max_frames, "Stop after so many images")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--set", arguments->settings,
                   "NAME=VALUE: any option of --print-config; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--quiet", arguments->quiet, "No progress, no table");
  command->add_flag("--print-config", arguments->print_config,
                    "Print all options with their meanings, as a file for --config, and exit");
  command->footer(HelpFooter("msc_vo replay my_sequence --output out/my_sequence"));
  command->callback([arguments, sequence] {
    if (sequence->empty() && !arguments->print_config) {
      throw CLI::RequiredError("sequence");
    }
  });
  return {command, [arguments] { return Replay(*arguments); }};
}

}  // namespace msc_vo
