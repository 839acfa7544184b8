// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/calibration_report.h"
#include "apps/cli/calibration_views.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/plot_file.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/datasets/calibration_correction.h"
#include "msc_vo/diagnosis/registration_edges.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// Every round runs the odometry with the calibration of the round before.
constexpr int kMaxRounds = 3;
// A correction that is smaller, in standard deviations, needs no further round.
constexpr double kMinCorrection = 0.5;

constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

struct Arguments {
  SequenceArguments layout;
  std::vector<std::string> sequences;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
  std::string plot;  // empty: none
};

bool SameCamera(const Calibration& a, const Calibration& b) {
  return FormatCameraYaml(a, "") == FormatCameraYaml(b, "");
}

std::vector<RgbdDecoder> OpenSequences(const Arguments& arguments,
                                       const Configuration& configuration) {
  std::vector<RgbdDecoder> decoders;
  for (const std::string& directory : arguments.sequences) {
    SequenceArguments sequence = arguments.layout;
    sequence.directory = directory;
    decoders.push_back(OpenDecoder(sequence, configuration));
    if (!SameCamera(decoders.front().calibration(), decoders.back().calibration())) {
      throw std::runtime_error(directory + ": its calibration differs from that of " +
                               arguments.sequences.front() +
                               "; calibrate the sequences of each camera together");
    }
  }
  return decoders;
}

// The same sequences with another calibration.
std::vector<RgbdDecoder> WithCalibration(const std::vector<RgbdDecoder>& decoders,
                                         const Calibration& calibration) {
  std::vector<RgbdDecoder> result;
  for (const RgbdDecoder& decoder : decoders) result.emplace_back(decoder.index(), calibration);
  return result;
}

// What the sequences tell about the calibration that they were tracked with.
struct TrackedSequences {
  std::vector<CalibrationSequence> views;
  CalibrationInformation of_maps;
};

// Runs the odometry on every sequence, selects images for the calibration, and adjusts the maps.
TrackedSequences TrackSequences(const std::vector<RgbdDecoder>& decoders,
                                const Configuration& configuration,
                                const RunArguments& run_arguments,
                                const InterruptGuard& interrupt) {
  TrackedSequences sequences;
  for (const RgbdDecoder& decoder : decoders) {
    RunCallbacks callbacks;
    callbacks.frame = [](const FrameResult&) {};
    const SequenceRun run =
        RunSequence(decoder, configuration, run_arguments, interrupt, callbacks);
    if (run.exit_code != kExitSuccess) {
      throw std::runtime_error(decoder.index().directory + ": " + run.context.outcome);
    }
    sequences.views.push_back(
        MakeCalibrationViews(decoder, configuration.odometry.features, run.result));
    const Calibration& present = decoder.calibration();
    const auto of_map = SelfCalibratingBundleAdjustment(
        {present.camera, present.distortion}, run.map->map, SensorCorrection::Vector::Zero());
    if (of_map) sequences.of_maps += *of_map;
  }
  return sequences;
}

std::vector<CalibrationResidual> ForPlots(const std::vector<PairResidual>& residuals,
                                          const PinholeCamera& recorded) {
  const Eigen::Vector2d center(0.5 * (recorded.width - 1), 0.5 * (recorded.height - 1));
  std::vector<CalibrationResidual> result;
  for (const PairResidual& residual : residuals) {
    result.push_back({(residual.pixel - center).norm(), residual.reprojection.norm(),
                      1.0 / residual.inverse_depth,
                      std::abs(residual.inverse_depth_error) / residual.inverse_depth});
  }
  return result;
}

bool NeedsAnotherRound(const CorrectionEstimate& estimate) {
  return (estimate.correction.cwiseQuotient(estimate.sigma).array().abs() > kMinCorrection).any();
}

CalibrationReport Calibrate(std::vector<RgbdDecoder> decoders, const Configuration& configuration,
                            const RunArguments& run, const InterruptGuard& interrupt) {
  CalibrationReport report;
  report.given = decoders.front().calibration();
  report.estimated = report.given;
  WrongGroups wrong = {}, right = {};
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto sequences = TrackSequences(decoders, configuration, run, interrupt);
    const Calibration& present = report.estimated;
    const auto calibrate = [&] {
      return CalibrateSensor(present.camera, present.distortion, sequences.views, wrong, right,
                             sequences.of_maps);
    };
    SensorCalibrationResult result = calibrate();
    const bool is_new = result.estimate.is_corrected[kRegistration] && !wrong[kRegistration];
    if (is_new && !EdgesAgree(decoders.front(), Corrected(present, result.estimate.correction))) {
      right[kRegistration] = report.edges_contradict = true;
      result = calibrate();
    }
    if (round == 0) {
      report.log_odds = result.estimate.log_odds;
      report.num_views = result.num_views;
      report.num_pairs = result.num_pairs;
      report.residuals.given = ForPlots(result.given_residuals, present.Recorded());
    }
    report.refinement = result.estimate;
    wrong = result.estimate.is_corrected;
    if (!result.estimate.IsCorrected()) break;
    report.residuals.estimated = ForPlots(result.estimated_residuals, present.Recorded());
    report.estimated = Corrected(present, result.estimate.correction);
    if (round > 0 && !NeedsAnotherRound(result.estimate)) break;
    decoders = WithCalibration(decoders, report.estimated);
  }
  return report;
}

// Refuses to write over the configuration, or into a folder of the sequence.
void RefuseOutput(const Arguments& arguments, const SequenceIndex& sequence) {
  if (!arguments.output.empty() && arguments.output == arguments.plot) {
    throw std::runtime_error(arguments.plot + ": --output and --plot name the same file");
  }
  for (const std::string& file : {arguments.output, arguments.plot}) {
    if (file.empty()) continue;
    RefuseToOverwrite({arguments.configuration.config}, file);
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    RefuseToOverwrite(InputFolders(sequence), folder.string());
  }
}

int Run(const Arguments& arguments) {
  Configuration configuration = MakeConfiguration(arguments.configuration);
  // The calibration is estimated from all images at once.
  configuration.odometry.mapping.self_calibration = false;
  std::vector<RgbdDecoder> decoders = OpenSequences(arguments, configuration);
  for (const RgbdDecoder& decoder : decoders) RefuseOutput(arguments, decoder.index());
  RunArguments run = arguments.run;
  run.quiet = run.quiet || run.json;
  const InterruptGuard interrupt;
  const CalibrationReport report = Calibrate(std::move(decoders), configuration, run, interrupt);
  std::cout << (arguments.run.json ? FormatCalibrationJson(report) : FormatCalibrationTable(report))
            << std::flush;
  if (!arguments.output.empty()) {
    WriteFile(arguments.output, FormatCameraYaml(report.estimated, "written by msc_vo calibrate"));
  }
  if (!arguments.plot.empty()) {
    WritePlotFile(arguments.plot,
                  CalibrationPage(report, "Calibration from " + arguments.sequences.front()));
  }
  return kExitSuccess;
}

}  // namespace

Command AddCalibrateCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "calibrate", "Estimate the calibration of an RGB-D camera from recorded sequences");
  command->add_option("sequences", arguments->sequences, "Folders with sequences of one camera")
      ->required();
  AddLayoutArguments(command, &arguments->layout);
  AddConfigurationArguments(command, &arguments->configuration);
  AddRunArguments(command, &arguments->run);
  command->add_option("--output", arguments->output,
                      "File for the estimated camera, YAML, to be used with --config");
  command
      ->add_option("--plot", arguments->plot,
                   "Write plots of the residuals before and after: .html or .svg")
      ->check(CheckPlotFileName);
  command->footer(HelpFooter("msc_vo calibrate my_sequence --output camera.yaml"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
