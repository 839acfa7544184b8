// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/exported_images.h"

#include <filesystem>
#include <optional>
#include <stdexcept>

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
    RefuseToOverwriteSequence(index, arguments.output);
  }
}

}  // namespace

std::string TrajectoryPath(const std::string& run) {
  return IsFolder(run) ? (std::filesystem::path(run) / "trajectory.txt").string() : run;
}

RgbdDecoder OpenExportedSequence(const RunExport& arguments) {
  SequenceArguments sequence = arguments.sequence;
  sequence.directory = SequencePath(arguments);
  Configuration configuration = MakeConfiguration(arguments.configuration);
  std::optional<Calibration> recorded;
  if (IsFolder(arguments.run) && sequence.camera.empty() && configuration.camera.IsEmpty()) {
    recorded = ReadRecordedRun(arguments.run).calibration;
  }
  if (!recorded) {
    RgbdDecoder decoder = OpenDecoder(sequence, configuration);
    RefuseToOverwriteImages(decoder.index(), arguments);
    return decoder;
  }
  const std::optional<int> max_width = configuration.camera.max_width;
  const std::optional<double> float_depth_scale = configuration.camera.float_depth_scale;
  configuration.camera = SettingsOf(*recorded);
  configuration.camera.max_width = max_width;
  configuration.camera.float_depth_scale = float_depth_scale;
  const RgbdDecoder decoder = OpenDecoder(sequence, configuration);
  RefuseToOverwriteImages(decoder.index(), arguments);
  // The camera of undistorted images is that of the run, which the settings do not have.
  return {decoder.index(), *recorded};
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
