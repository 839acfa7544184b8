// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/cli/argument_checks.h"
#include "apps/cli/calibration_report.h"
#include "apps/cli/calibration_rounds.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/output_file.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/config/camera_options.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// The files that the command has written contain these.
constexpr char kCameraMark[] = "written by msc_vo calibrate";
constexpr char kPlotTitle[] = "Calibration from ";

struct CalibrateArguments {
  SequenceArguments layout;
  std::vector<std::string> sequences;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
  std::string plot;  // empty: none
};

// Throws std::runtime_error if a sequence is named twice: it would count as further evidence.
void RefuseRepeats(const std::vector<std::string>& sequences) {
  std::map<std::string, std::string> seen;  // by the path without links
  for (const std::string& sequence : sequences) {
    std::error_code error;
    const std::string path = std::filesystem::canonical(sequence, error).string();
    if (error) continue;  // opening the sequence reports it
    const auto [first, is_new] = seen.emplace(path, sequence);
    if (is_new) continue;
    throw std::runtime_error(sequence + ": is the same sequence as " + first->second +
                             ", and would count twice; give each sequence once");
  }
}

// Opens the sequences. A readout time of the options takes precedence over that of a calibration.
std::vector<RgbdDecoder> OpenSequences(const CalibrateArguments& arguments,
                                       const Configuration& configuration) {
  RefuseRepeats(arguments.sequences);
  std::vector<RgbdDecoder> decoders;
  for (const std::string& directory : arguments.sequences) {
    SequenceArguments sequence = arguments.layout;
    sequence.directory = directory;
    const RgbdDecoder decoder = OpenDecoder(sequence, configuration);
    PrintWarnings(decoder.Warnings());
    CheckInput(decoder);
    Calibration calibration = decoder.calibration();
    const std::optional<double>& readout_time = configuration.odometry.mapping.readout_time;
    if (readout_time) calibration.readout_time = readout_time;
    decoders.emplace_back(decoder.index(), calibration);
    const std::string difference = DescribeDifference(calibration, decoders.front().calibration());
    if (!difference.empty()) {
      throw std::runtime_error(directory + ": its calibration differs from that of " +
                               arguments.sequences.front() + " (" + difference +
                               "); calibrate the sequences of each camera together");
    }
  }
  return decoders;
}

void CheckOutputs(const CalibrateArguments& arguments, const std::vector<RgbdDecoder>& decoders) {
  if (!arguments.output.empty() && arguments.output == arguments.plot) {
    throw UsageError(arguments.plot + ": --output and --plot name the same file");
  }
  std::vector<SequenceIndex> sequences;
  for (const RgbdDecoder& decoder : decoders) sequences.push_back(decoder.index());
  const std::vector<std::string> inputs = arguments.configuration.InputFiles();
  if (!arguments.output.empty())
    CheckOutputFile(arguments.output, inputs, sequences, {kCameraMark});
  if (arguments.plot.empty()) return;
  CheckOutputFile(arguments.plot, inputs, sequences, {std::string("<title>") + kPlotTitle});
}

// Prints the results and writes the files, first the one that counts. `stored_size`: of the colour
// images, if they are reduced. Throws std::runtime_error if the estimate is no camera.
void WriteResults(const CalibrateArguments& arguments, const std::optional<ImageSize>& stored_size,
                  const CalibrationReport& report) {
  if (arguments.run.json) {
    std::cout << FormatCalibrationJson(report) << std::flush;
  } else if (!arguments.run.quiet) {
    std::cout << FormatCalibrationTable(report) << std::flush;
  }
  if (report.problem.empty() && !arguments.output.empty()) {
    const Calibration stored = StoredCalibration(report.used, stored_size);
    WriteFile(arguments.output, FormatChangedOptions(CameraConfiguration(stored), kCameraMark));
  }
  if (!arguments.plot.empty()) {
    WritePlotFile(arguments.plot,
                  CalibrationPage(report, kPlotTitle + arguments.sequences.front()));
  }
  if (!report.problem.empty()) throw std::runtime_error(report.problem);
}

int Run(const CalibrateArguments& arguments) {
  Configuration configuration = MakeConfiguration(arguments.configuration);
  std::vector<RgbdDecoder> decoders = OpenSequences(arguments, configuration);
  const std::optional<ImageSize> stored_size = decoders.front().index().reduced_from;
  UseDepthSensorOf(decoders.front().index(), &configuration.odometry);
  CheckOutputs(arguments, decoders);
  RunArguments run = arguments.run;
  run.quiet = run.quiet || run.json;
  const InterruptGuard interrupt;
  CalibrationRounds rounds(std::move(decoders), configuration, run, interrupt);
  const ExitCode exit_code = rounds.Run();
  if (exit_code == kExitSuccess) WriteResults(arguments, stored_size, rounds.report());
  return exit_code;
}

}  // namespace

Command AddCalibrateCommand(CLI::App* app) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app->add_subcommand(
      "calibrate", "Estimate the calibration of an RGB-D camera from recorded sequences");
  command->add_option("sequences", arguments->sequences, "Folders with sequences of one camera")
      ->required();
  AddLayoutArguments(command, &arguments->layout);
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  AddDepthSensorArgument(command, &arguments->configuration);
  AddRunArguments(command, &arguments->run);
  command->add_option("--output", arguments->output,
                      "File for the estimated camera, YAML, to be used with --camera-file or "
                      "--config; in the folder of a sequence, only that of an earlier "
                      "calibration is replaced");
  command
      ->add_option("--plot", arguments->plot,
                   "Write plots of the residuals before and after: .html or .svg")
      ->check(CheckPlotFileName);
  command->footer(HelpFooter("msc_vo calibrate my_sequence --output camera.yaml"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
