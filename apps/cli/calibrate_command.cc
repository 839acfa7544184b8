// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "apps/cli/calibration_views.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct Arguments {
  SequenceArguments layout;
  std::vector<std::string> sequences;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
};

int Run(const Arguments& arguments) {
  const Configuration configuration = MakeConfiguration(arguments.configuration);
  InterruptGuard interrupt;
  std::vector<CalibrationSequence> sequences;
  PinholeCamera camera;
  LensDistortion distortion;
  for (const std::string& directory : arguments.sequences) {
    SequenceArguments sequence = arguments.layout;
    sequence.directory = directory;
    const RgbdDecoder decoder = OpenDecoder(sequence, configuration);
    RunCallbacks callbacks;
    callbacks.frame = [](const FrameResult&) {};
    const SequenceRun run =
        RunSequence(decoder, configuration, arguments.run, interrupt, callbacks);
    camera = decoder.calibration().camera;
    distortion = decoder.calibration().distortion;
    sequences.push_back(MakeCalibrationViews(decoder, configuration.odometry.features, run.result));
  }
  const SensorCalibrationResult result = CalibrateSensor(camera, distortion, sequences, {});
  static const char* const kNames[] = {"f",  "cx",   "cy", "k1", "k2",  "fd",  "dx",
                                       "dy", "roll", "tx", "ty", "off", "bowl"};
  std::cout << FormatText("%d views %d pairs;", result.num_views, result.num_pairs);
  for (int g = 0; g < 4; ++g)
    std::cout << FormatText(" %d:%.1f", int(result.estimate.is_corrected[g]),
                            result.estimate.log_odds[g]);
  for (int i = 0; i < SensorCorrection::kSize; ++i)
    std::cout << FormatText(" %s %.4f %.4f(%.4f)", kNames[i], result.estimate.correction(i),
                            result.estimate.free_correction(i), result.estimate.sigma(i));
  std::cout << "\n";
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
  command->footer(HelpFooter("msc_vo calibrate my_sequence --output camera.yaml"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
