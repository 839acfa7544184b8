// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/progress.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/datasets/camera_source.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/datasets/tum_writer.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Seconds of images of a camera that wait for the disk: 40 MiB at 30 Hz.
constexpr double kMaxWaiting = 1.0;

struct RecordArguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  std::string folder;
  int max_frames = 0;  // 0: all
  bool json = false;
};

struct Recording {
  int num_unreadable = 0;
  int num_dropped = 0;
  std::string first_unreadable;
  std::string failure;  // empty unless the source or the disk failed
  bool is_interrupted = false;
};

bool IsFull(const RecordArguments& arguments, int num_pairs) {
  return arguments.max_frames > 0 && num_pairs >= arguments.max_frames;
}

void RecordSequence(const RecordArguments& arguments, const RgbdDecoder& decoder,
                    const InterruptGuard& interrupt, TumWriter* writer, Recording* recording) {
  Progress progress(decoder.size());
  for (int i = 0; i < decoder.size() && !IsFull(arguments, writer->num_pairs()); ++i) {
    if (interrupt.IsInterrupted()) {
      recording->is_interrupted = true;
      break;
    }
    const SequenceEntry& entry = decoder.index().entries[i];
    try {
      const StoredRgbd images = decoder.ReadForExport(i);
      writer->Add(entry.timestamp, entry.timestamp + entry.depth_delay, images.color, images.depth,
                  images.mask);
    } catch (const UnreadableImage& error) {
      if (recording->num_unreadable++ == 0) recording->first_unreadable = error.what();
    }
    progress.Update(i + 1, "");
  }
  progress.Finish();
}

// Until Ctrl-C, which is how a live recording ends.
void RecordCamera(const RecordArguments& arguments, const RgbdDecoder& decoder,
                  const InterruptGuard& interrupt, TumWriter* writer, Recording* recording) {
  CameraSource source(decoder.index().camera.get(), kMaxWaiting);
  Progress progress(arguments.max_frames);
  CameraImage image;
  while (!interrupt.IsInterrupted() && !IsFull(arguments, writer->num_pairs()) &&
         source.Next(&image, &recording->num_dropped)) {
    const cv::Mat mask = decoder.index().masks ? decoder.Convert(image, 0).mask : cv::Mat();
    writer->Add(image.timestamp, image.timestamp + image.depth_delay, {"", image.color},
                {"", image.depth}, mask);
    progress.Update(writer->num_pairs(), "");
  }
  progress.Finish();
}

// Depth in metres is written with a scale of its own, whatever that of the calibration, which it
// does not use.
Calibration RecordedCalibration(const RgbdDecoder& decoder) {
  constexpr double kUnitsPerMetre = 5000.0;
  Calibration calibration = decoder.calibration();
  if (decoder.index().clipped_depth.is_metric) calibration.depth_scale = kUnitsPerMetre;
  calibration.depth_sensor = decoder.index().GivenDepthSensor();
  return calibration;
}

void WriteTruth(const SequenceIndex& index, const std::string& folder) {
  if (index.ground_truth.empty()) return;
  const std::string comment =
      index.reference.empty() ? "" : "# " + (kReferenceComment + index.reference) + "\n";
  WriteFile(folder + "/" + TruthFileName(index), comment + FormatTrajectory(index.ground_truth));
}

// The folder of the masks that were recorded; empty: none.
std::string MaskFolder(const RecordArguments& arguments, const TumWriter& writer) {
  if (arguments.sequence.mask.empty() || writer.num_pairs() == 0) return "";
  return (std::filesystem::path(arguments.folder) / "mask").string();
}

void Print(const RecordArguments& arguments, const TumWriter& writer, const Recording& recording) {
  const std::string masks = MaskFolder(arguments, writer);
  if (arguments.json) {
    const nlohmann::ordered_json json = {
        {"directory", arguments.folder},
        {"source", arguments.sequence.directory},
        {"mask", masks.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(masks)},
        {"images", writer.num_pairs()},
        {"unreadable", recording.num_unreadable},
        {"dropped", recording.num_dropped},
        {"complete", recording.failure.empty() && !recording.is_interrupted}};
    std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  } else {
    std::cout << writer.num_pairs() << " image pairs in " << arguments.folder << std::endl;
    if (!masks.empty()) std::cout << "with masks; read it with --mask " << masks << std::endl;
  }
  if (recording.num_unreadable > 0) {
    PrintWarning(FormatText("%d images cannot be read and are left out; the first: ",
                            recording.num_unreadable) +
                 recording.first_unreadable);
  }
  if (recording.num_dropped > 0) {
    PrintWarning(FormatText("%d images of the camera were dropped, because the disk was late",
                            recording.num_dropped));
  }
}

int Run(const RecordArguments& arguments) {
  const RgbdDecoder decoder = OpenDecoder(
      arguments.sequence, MakeConfiguration(arguments.configuration), LiveCameras::kAllowed);
  PrintWarnings(decoder.Warnings());
  RefuseToOverwrite(InputFolders(decoder.index()), arguments.folder);
  const InterruptGuard interrupt;
  TumWriter writer(arguments.folder, RecordedCalibration(decoder),
                   "recorded by msc_vo from " + decoder.index().directory);
  WriteTruth(decoder.index(), arguments.folder);
  Recording recording;
  try {
    if (decoder.index().camera) {
      RecordCamera(arguments, decoder, interrupt, &writer, &recording);
    } else {
      RecordSequence(arguments, decoder, interrupt, &writer, &recording);
    }
  } catch (const std::exception& error) {
    recording.failure = error.what();
  }
  Print(arguments, writer, recording);
  if (!recording.failure.empty()) {
    throw std::runtime_error(recording.failure + "\n(" + arguments.folder + " holds the " +
                             std::to_string(writer.num_pairs()) + " image pairs before)");
  }
  if (recording.is_interrupted) return kExitInterrupted;
  if (writer.num_pairs() == 0) {
    throw std::runtime_error(arguments.sequence.directory + ": no image was recorded");
  }
  return kExitSuccess;
}

}  // namespace

Command AddRecordCommand(CLI::App* app) {
  const auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command = app->add_subcommand(
      "record", "Write a camera, a ROS bag or another sequence as a folder in TUM layout");
  AddSequenceArguments(command, &arguments->sequence)->required();
  command->add_option("folder", arguments->folder, "Folder to write; must be empty or new")
      ->required();
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->add_option("--max-frames", arguments->max_frames, "Stop after N image pairs")
      ->transform(WholeNumberFrom(1, std::numeric_limits<int>::max()));
  command->add_flag("--json", arguments->json, "Print what was written as JSON");
  command->footer(HelpFooter("msc_vo record openni2: my_sequence"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
