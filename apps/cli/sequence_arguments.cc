// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/sequence_arguments.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {

CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments) {
  CLI::Option* sequence =
      command->add_option("sequence", arguments->directory, "Folder with an RGB-D sequence");
  AddLayoutArguments(command, arguments);
  return sequence;
}

void AddLayoutArguments(CLI::App* command, SequenceArguments* arguments) {
  std::vector<std::string> formats = SequenceFormatNames();
  formats.insert(formats.begin(), "auto");
  command->add_option("--format", arguments->format, "Layout of the folder")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
  std::vector<std::string> cameras;
  for (const CameraPreset& preset : CameraPresets()) cameras.push_back(preset.name);
  command
      ->add_option("--camera", arguments->camera,
                   "Built-in calibration, used if neither --config nor the folder has one")
      ->check(CLI::IsMember(cameras));
}

RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration) {
  SequenceIndex index = OpenSequence(arguments.directory, arguments.format);
  Calibration calibration = ResolveCalibration(configuration.camera, arguments.camera, &index);
  return {std::move(index), std::move(calibration)};
}

std::string SequenceName(const std::string& directory) {
  // Resolves paths such as "." and "a/..".
  std::error_code error;
  std::filesystem::path path = std::filesystem::weakly_canonical(directory, error);
  if (error) path = directory;  // opening the sequence reports the error
  const std::filesystem::path name =
      path.has_filename() ? path.filename() : path.parent_path().filename();
  return name.empty() ? "root" : name.string();
}

}  // namespace msc_vo
