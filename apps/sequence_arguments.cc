// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/sequence_arguments.h"

#include <utility>
#include <vector>

#include "msc_vo/io/camera_preset.h"
#include "msc_vo/io/options_file.h"
#include "msc_vo/io/sequence.h"

namespace msc_vo {

CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments) {
  CLI::Option* sequence = command->add_option("sequence", arguments->directory,
                                              "Folder with an RGB-D sequence, see --format");
  std::vector<std::string> formats = SequenceFormatNames();
  formats.insert(formats.begin(), "auto");
  command->add_option("--format", arguments->format, "Layout of the folder")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
  std::vector<std::string> cameras;
  for (const CameraPreset& preset : CameraPresets()) cameras.push_back(preset.name);
  command
      ->add_option("--camera", arguments->camera,
                   "Built-in camera, if neither --config nor the folder knows it")
      ->check(CLI::IsMember(cameras));
  command->add_option("--config", arguments->config,
                      "Options and camera: our YAML (see replay --print-config) or ORB-SLAM's");
  return sequence;
}

RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration) {
  SequenceIndex index = OpenSequence(arguments.directory, arguments.format);
  Calibration calibration = ResolveCalibration(configuration.camera, arguments.camera, &index);
  return {std::move(index), std::move(calibration)};
}

Configuration LoadConfiguration(const SequenceArguments& arguments) {
  Configuration configuration;
  if (!arguments.config.empty()) ReadConfiguration(arguments.config, &configuration);
  return configuration;
}

}  // namespace msc_vo
