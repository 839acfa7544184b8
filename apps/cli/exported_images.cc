// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/exported_images.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/cli/output_file.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/exports/recorded_run.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// The sequence that was given, or that of the results.
std::string SequencePath(const RunExport& arguments) {
  if (!arguments.sequence.directory.empty()) return arguments.sequence.directory;
  const auto identity = ReadIdentity(arguments.run);
  if (identity && !identity->path.empty()) return identity->path;
  throw std::runtime_error(arguments.run +
                           ": does not say of which sequence it is; give it with --sequence");
}

void RefuseToOverwriteImages(const SequenceIndex& index, const RunExport& arguments) {
  if (arguments.format == "colmap") {
    RefuseToOverwrite(InputFolders(index), arguments.output);
  } else {
    RefuseToReplaceInSequence(index, arguments.output, KindOfExport(arguments.format),
                              arguments.overwrite);
  }
}

// Throws std::runtime_error if the run read the images with other settings of their source.
void CheckSettings(const SequenceIndex& index, const RecordedReading& reading) {
  const std::string settings = index.container ? index.container->Settings() : "";
  if (settings == reading.settings) return;
  throw std::runtime_error(index.directory + ": the run read it with other settings (" +
                           reading.settings + "; now: " + settings +
                           "); give --min-confidence as in the run");
}

}  // namespace

std::string TrajectoryPath(const std::string& run) {
  return IsFolder(run) ? (std::filesystem::path(run) / "trajectory.txt").string() : run;
}

RgbdDecoder OpenExportedSequence(const RunExport& arguments) {
  SequenceArguments sequence = arguments.sequence;
  sequence.directory = SequencePath(arguments);
  Configuration configuration = MakeConfiguration(arguments.configuration);
  const RecordedRun run = IsFolder(arguments.run) ? ReadRecordedRun(arguments.run) : RecordedRun();
  const RecordedReading reading = run.reading.value_or(RecordedReading());
  if (sequence.mask.empty()) {
    sequence.mask = reading.mask;
    sequence.mask_zero = reading.mask_zero;
  }
  CameraSettings& camera = configuration.camera;
  const bool is_as_recorded = run.calibration && sequence.camera.empty() && camera.IsEmpty();
  if (is_as_recorded) {
    const double float_depth_scale = camera.float_depth_scale.value_or(reading.float_depth_scale);
    camera = SettingsOf(*run.calibration);
    camera.max_width = run.calibration->Recorded().width;
    camera.float_depth_scale = float_depth_scale;
  }
  RgbdDecoder decoder = OpenDecoder(sequence, configuration);
  RefuseToOverwriteImages(decoder.index(), arguments);
  if (run.reading) CheckSettings(decoder.index(), reading);
  if (!is_as_recorded) return decoder;
  // The settings have neither the camera of undistorted images nor the size of colour images that
  // the run reduced.
  SequenceIndex index = decoder.index();
  index.scale_color = index.scale_color || reading.color_is_reduced;
  return {std::move(index), *run.calibration};
}

void RequireImageFiles(const RgbdDecoder& decoder) {
  const std::string& name = decoder.index().directory;
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
}

}  // namespace msc_vo
