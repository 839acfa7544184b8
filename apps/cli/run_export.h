// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/cli/configuration_arguments.h"
#include "apps/cli/depth_fusion.h"
#include "apps/cli/output_file.h"
#include "apps/cli/posed_images.h"
#include "apps/cli/sequence_arguments.h"

namespace msc_vo {

/// Results of a run in the format of another program.
struct RunExport {
  std::string run;             ///< folder of results, or a trajectory
  std::string map;             ///< map file of the run; for mcap it may be empty
  std::string format;          ///< one of ExportFormats()
  std::string output;          ///< file; for colmap a folder
  std::string session;         ///< mcap, colmap: name of the session of the map; may be empty
  SequenceArguments sequence;  ///< its directory is that of the results if empty
  ConfigurationArguments configuration;
  PoseSelection poses;
  bool binary = false;            ///< colmap
  bool images = false;            ///< mcap
  std::optional<bool> overwrite;  ///< see RefuseToReplace()
  /// mcap: whether a map without keyframes of the run is an error; else features are left out with
  /// a warning.
  bool requires_features = true;
  SurfaceFusionOptions fusion;  ///< ply
};

/// The names of the formats.
const std::vector<std::string>& ExportFormats();

/// Whether a format is made of a map file: colmap and g2o.
bool IsMapFormat(const std::string& format);

/// How earlier exports of a format are recognised.
OutputKind KindOfExport(const std::string& format);

/// Throws std::runtime_error that names the fix if a format cannot be made of a sequence, or not by
/// this build.
void CheckExport(const RunExport& arguments, const RgbdDecoder& sequence);

/// Writes an export. Throws std::runtime_error, naming the file and the fix, and Interrupted.
void WriteExport(const RunExport& arguments);

}  // namespace msc_vo
