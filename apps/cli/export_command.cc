// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/number_range.h"
#include "apps/cli/posed_images.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/exports/colmap_model.h"
#include "msc_vo/exports/map_export.h"
#include "msc_vo/exports/nerfstudio.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/exports/trajectory_export.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string run;
  std::string format;
  std::string output;
  SequenceArguments sequence;  // its directory is that of the run if empty
  ConfigurationArguments configuration;
  PoseSelection poses;
  bool binary = false;
};

bool IsMapFormat(const std::string& format) { return format == "colmap" || format == "g2o"; }

// The trajectory of a folder of results, or the file itself.
std::string TrajectoryPath(const std::string& run) {
  return IsFolder(run) ? (fs::path(run) / "trajectory.txt").string() : run;
}

// The sequence that was given, or that of the results.
std::string SequencePath(const ExportArguments& arguments) {
  if (!arguments.sequence.directory.empty()) return arguments.sequence.directory;
  const auto identity = ReadIdentity(arguments.run);
  if (identity && !identity->path.empty()) return identity->path;
  throw std::runtime_error(arguments.run +
                           ": does not say of which sequence it is; give it with --sequence");
}

RgbdDecoder OpenImages(const ExportArguments& arguments) {
  SequenceArguments sequence = arguments.sequence;
  sequence.directory = SequencePath(arguments);
  RgbdDecoder decoder = OpenDecoder(sequence, MakeConfiguration(arguments.configuration));
  const std::string& name = sequence.directory;
  if (decoder.index().container) {
    throw std::runtime_error(name +
                             ": has its images in one file, which the other program cannot read; "
                             "make a folder of it with msc_vo record");
  }
  if (decoder.index().scale_color) {
    throw std::runtime_error(name +
                             ": its colour images are reduced when they are read, so that the "
                             "camera would not fit the files; make a folder of the reduced ones "
                             "with msc_vo record");
  }
  return decoder;
}

std::string ExportNerfstudio(const ExportArguments& arguments) {
  const RgbdDecoder decoder = OpenImages(arguments);
  const Calibration& calibration = decoder.calibration();
  const auto absolute = [](const std::string& path) {
    return fs::absolute(path).lexically_normal().string();
  };
  std::vector<NerfstudioFrame> frames;
  for (const PosedImage& image :
       FindPosedImages(TrajectoryPath(arguments.run), arguments.poses, decoder)) {
    const SequenceEntry& entry = decoder.index().entries[static_cast<size_t>(image.index)];
    frames.push_back({absolute(entry.color_path),
                      calibration.depth_camera ? "" : absolute(entry.depth_path),
                      image.pose.world_from_cam});
  }
  return FormatNerfstudio(ExportCamera({calibration.camera, calibration.distortion}), frames);
}

// Lines of KITTI are the numbers of frames, for other programs.
void WarnOfMissingLines(const std::string& path, size_t num_lines) {
  const size_t num_frames = ReadTrajectory(path).size();
  if (num_lines == num_frames) return;
  PrintWarning(
      FormatText("%s: %zu of %zu poses are exported, so that lines are not the numbers of "
                 "frames; --all-poses takes predicted ones, too",
                 path.c_str(), num_lines, num_frames));
}

std::string FormatPoses(const ExportArguments& arguments) {
  const std::string path = TrajectoryPath(arguments.run);
  if (arguments.format == "nerfstudio") return ExportNerfstudio(arguments);
  if (arguments.format == "tum") return FormatTrajectory(ReadPoses(path, arguments.poses));
  const std::vector<TimedPose> poses = ReadPosesOfOneWorld(path, arguments.poses);
  if (arguments.format == "euroc") return FormatEuroc(poses);
  WarnOfMissingLines(path, poses.size());
  return FormatKitti(poses);
}

// The submap with most keyframes: other programs know one world only.
SavedSubMap LargestSubMap(const std::string& file, MapContents* contents) {
  if (contents->submaps.empty()) throw std::runtime_error(file + ": has no submap");
  const auto largest =
      std::max_element(contents->submaps.begin(), contents->submaps.end(),
                       [](const SavedSubMap& a, const SavedSubMap& b) {
                         return a.map.keyframes().size() < b.map.keyframes().size();
                       });
  if (contents->submaps.size() > 1) {
    PrintWarning(FormatText("%s: of %zu submaps, submap %d with %zu keyframes is exported",
                            file.c_str(), contents->submaps.size(), largest->id,
                            largest->map.keyframes().size()));
  }
  return std::move(*largest);
}

// Names the image of a keyframe by the sequence, if that is given, or else by its number.
std::function<std::string(const Keyframe&)> ImageNames(const ExportArguments& arguments) {
  if (arguments.sequence.directory.empty()) {
    return [](const Keyframe& keyframe) {
      return FormatText("keyframe_%06lld.png", static_cast<long long>(keyframe.id));
    };
  }
  const auto decoder = std::make_shared<const RgbdDecoder>(OpenImages(arguments));
  return [decoder](const Keyframe& keyframe) {
    const std::string& directory = decoder->index().directory;
    const std::vector<SequenceEntry>& entries = decoder->index().entries;
    const auto delay = [&](const SequenceEntry& entry) {
      return std::abs(entry.timestamp - keyframe.frame->timestamp);
    };
    const auto nearest = std::min_element(
        entries.begin(), entries.end(),
        [&](const SequenceEntry& a, const SequenceEntry& b) { return delay(a) < delay(b); });
    if (delay(*nearest) > kMaxPoseDelay) {
      throw std::runtime_error(FormatText(
          "%s: has no image of the keyframe at %.6f s; a map of several sequences is exported "
          "without --sequence",
          directory.c_str(), keyframe.frame->timestamp));
    }
    if (keyframe.frame->camera.width != decoder->calibration().camera.width) {
      throw std::runtime_error(directory + ": its images have another size than those of the map");
    }
    return fs::path(nearest->color_path).lexically_relative(directory).string();
  };
}

void ExportMapFile(const ExportArguments& arguments) {
  if (IsFolder(arguments.run)) {
    throw std::runtime_error(arguments.run + ": results of a run have no observations of points; " +
                             "run again with --map home.map, and export home.map");
  }
  RefuseToOverwrite({arguments.run}, arguments.output);
  MapContents contents = LoadMap(arguments.run);
  const SavedSubMap submap = LargestSubMap(arguments.run, &contents);
  if (arguments.format == "g2o") {
    WriteFile(arguments.output, FormatG2o(submap, contents.loops));
    return;
  }
  const ColmapModel model = MakeColmapModel(submap.map, ImageNames(arguments));
  MakeFolder(arguments.output);
  for (const ModelFile& file :
       arguments.binary ? FormatColmapBinary(model) : FormatColmapText(model)) {
    WriteFile((fs::path(arguments.output) / file.name).string(), file.content);
  }
}

// Refuses options that would have no effect.
void CheckOptions(const ExportArguments& arguments) {
  const auto refuse = [&](const char* option) {
    throw std::runtime_error(std::string(option) + " has no effect on the format " +
                             arguments.format + "; leave it out");
  };
  if (arguments.binary && arguments.format != "colmap") refuse("--binary");
  if (!IsMapFormat(arguments.format)) return;
  if (arguments.poses.every != 1) refuse("--every");
  if (arguments.poses.all_poses) refuse("--all-poses");
}

int Export(const ExportArguments& arguments) {
  CheckOptions(arguments);
  if (IsMapFormat(arguments.format)) {
    ExportMapFile(arguments);
  } else {
    RefuseToOverwrite({TrajectoryPath(arguments.run)}, arguments.output);
    WriteFile(arguments.output, FormatPoses(arguments));
  }
  std::cout << "written to " << arguments.output << std::endl;
  return kExitSuccess;
}

}  // namespace

Command AddExportCommand(CLI::App* app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app->add_subcommand(
      "export", "Write the results of a run, or a map, in the format of another program");
  command
      ->add_option("run", arguments->run,
                   "Folder of results, trajectory, or, for colmap and g2o, a map file of --map")
      ->required();
  command->add_option("format", arguments->format, "Format of the other program")
      ->check(CLI::IsMember({"colmap", "euroc", "g2o", "kitti", "nerfstudio", "tum"}))
      ->required();
  command->add_option("output", arguments->output, "File to write; for colmap, a folder")
      ->required();
  command->add_option("--sequence", arguments->sequence.directory,
                      "Sequence whose images nerfstudio and colmap name; default: that of the "
                      "results, for colmap numbers");
  AddLayoutArguments(command, &arguments->sequence);
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->add_option("--every", arguments->poses.every, "Export every N-th pose only")
      ->check(NumberFrom(1, 1e6))
      ->capture_default_str();
  command->add_flag("--all-poses", arguments->poses.all_poses,
                    "Also poses that are not estimated from the image, but predicted");
  command->add_flag("--binary", arguments->binary, "For colmap: the binary form");
  command->footer(HelpFooter("msc_vo export out/my_sequence nerfstudio transforms.json"));
  return {command, [arguments] { return Export(*arguments); }};
}

}  // namespace msc_vo
