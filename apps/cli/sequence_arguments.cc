// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/sequence_arguments.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/map_argument.h"
#include "apps/cli/modules.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/clipped_depth_search.h"
#include "msc_vo/datasets/image_masks.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/sequence_check.h"
#include "msc_vo/openni/openni_source.h"
#include "msc_vo/phone_recordings/folder_sequence.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kCameraPrefix[] = "openni2:";

bool IsOni(const std::string& path) {
  return Lowercase(std::filesystem::path(path).extension().string()) == ".oni" && !IsFolder(path);
}

SequenceIndex OpenSource(const SequenceArguments& arguments) {
  const std::string& source = arguments.directory;
  RefuseMapFile(source, "give a sequence; replay takes a map with --map or --localize");
  const bool is_bag = IsBag(source);
  if (!is_bag && (!arguments.topics.color.empty() || !arguments.topics.depth.empty())) {
    throw UsageError(source +
                     ": --color-topic and --depth-topic are for ROS bags (.bag, .db3, .mcap)");
  }
  if (IsLiveCamera(source)) return OpenOpenNiCamera(source.substr(sizeof(kCameraPrefix) - 1));
  if (is_bag) return OpenBag(source, arguments.topics);
  if (IsOni(source)) return OpenOniFile(source);
  const PhoneOptions options = {DepthConfidenceFromName(arguments.min_confidence), LoadVideoReader};
  return OpenFolder(source, arguments.format, options);
}

// The sequences in a folder and in the one that holds it; either may be none.
std::vector<SequenceIndex> SequencesAround(const std::string& folder) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(folder, error).lexically_normal();
  std::vector<SequenceIndex> sequences;
  SequenceArguments arguments;
  for (const std::filesystem::path& directory :
       {path, (path.has_filename() ? path : path.parent_path()).parent_path()}) {
    arguments.directory = directory.string();
    try {
      sequences.push_back(OpenSource(arguments));
    } catch (const std::exception&) {  // is none
    }
  }
  return sequences;
}

}  // namespace

void RefuseSequenceFolder(const std::string& folder) {
  if (!IsFolder(folder)) return;
  for (const SequenceIndex& index : SequencesAround(folder)) {
    RefuseToOverwrite(InputFolders(index), folder);
  }
}

void RefuseSequenceFile(const std::string& file) {
  for (const SequenceIndex& index : SequencesAround(ParentFolder(file))) {
    RefuseToOverwriteSequence(index, file);
  }
}

bool IsLiveCamera(const std::string& directory) { return directory.rfind(kCameraPrefix, 0) == 0; }

CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments) {
  CLI::Option* sequence = command->add_option("sequence", arguments->directory,
                                              "Folder with an RGB-D sequence, ROS bag (.bag, .db3, "
                                              ".mcap or their folder), OpenNI2 recording (.oni) "
                                              "or camera (openni2:)");
  AddLayoutArguments(command, arguments);
  return sequence;
}

void AddLayoutArguments(CLI::App* command, SequenceArguments* arguments) {
  std::vector<std::string> formats = FolderFormatNames();
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
  command->add_option("--color-topic", arguments->topics.color,
                      "Topic of the colour images of a ROS bag; default: found by its type");
  command->add_option("--depth-topic", arguments->topics.depth,
                      "Topic of the depth images of a ROS bag; default: found by its type");
  command
      ->add_option("--min-confidence", arguments->min_confidence,
                   "Least confidence of the depths of a telephone that are used")
      ->check(CLI::IsMember({"low", "medium", "high"}))
      ->capture_default_str();
  CLI::Option* const mask = command->add_option(
      "--mask", arguments->mask,
      "Image whose pixels that are not zero are left out of all images (a robot's own arm), or "
      "folder with one for each image, by name (people found by a detector)");
  command
      ->add_flag("--mask-zero", arguments->mask_zero,
                 "Leave out pixels of the mask that are zero instead, as in masks of COLMAP")
      ->needs(mask);
}

RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration,
                        LiveCameras live_cameras) {
  if (live_cameras == LiveCameras::kRefused && IsLiveCamera(arguments.directory)) {
    throw std::runtime_error(arguments.directory +
                             ": this command needs a recording; make one with msc_vo record");
  }
  SequenceIndex index = OpenSource(arguments);
  Calibration calibration = ResolveCalibration(configuration.camera, arguments.camera, &index);
  index.clipped_depth = FindClippedDepth(index);
  index.masks = OpenMasks(arguments.mask, arguments.mask_zero, index);
  return {std::move(index), std::move(calibration)};
}

std::vector<std::string> CheckInput(const RgbdDecoder& decoder, const std::string& advice) {
  std::vector<std::string> warnings;
  for (const Finding& finding : CheckSequenceQuickly(decoder)) {
    if (finding.severity == Severity::kError) {
      throw std::runtime_error(decoder.index().directory + ": " + Describe(finding) +
                               " (for details, run msc_vo check" + advice + ")");
    }
    warnings.push_back(Describe(finding));
  }
  return warnings;
}

void UseDepthSensorOf(const SequenceIndex& index, OdometryOptions* options) {
  DepthSensor& sensor = options->features.depth_sensor;
  if (sensor == DepthSensor::kAuto) sensor = index.GivenDepthSensor();
}

std::string SequenceName(const std::string& directory) {
  if (IsLiveCamera(directory)) return "openni2";
  // Resolves paths such as "." and "a/..".
  std::error_code error;
  std::filesystem::path path = std::filesystem::weakly_canonical(directory, error);
  if (error) path = directory;  // opening the sequence reports the error
  const std::filesystem::path name =
      path.has_filename() ? path.filename() : path.parent_path().filename();
  if (IsBag(directory)) return BagName(directory);
  if (IsOni(directory)) return name.stem().string();
  return name.empty() ? "root" : name.string();
}

}  // namespace msc_vo
