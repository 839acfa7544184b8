// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/replay_exports.h"

#include <algorithm>
#include <stdexcept>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/exported_map.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/output_file.h"
#include "msc_vo/exports/colmap_model.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::string FormatOf(const std::string& text) { return text.substr(0, text.find('=')); }

// The argument that made an export.
std::string NameOf(const RunExport& one) { return "--export " + one.format + "=" + one.output; }

void CheckBeforeRun(const RunExport& one, const ReplayArguments& arguments,
                    const RgbdDecoder& sequence) {
  if (IsMapFormat(one.format) && one.map.empty()) {
    throw std::runtime_error("is made of the map of the run; add --map FILE");
  }
  CheckExport(one, sequence);
  if (IsMapFormat(one.format)) CheckMapExport(one);
  std::vector<std::string> inputs = arguments.configuration.InputFiles();
  inputs.insert(inputs.end(), {one.map, arguments.map.localize});
  if (one.format != "colmap") {
    return CheckOutputFile(one.output, inputs, {sequence.index()}, KindOfExport(one.format),
                           one.overwrite);
  }
  RefuseToOverwrite(InputFolders(sequence.index()), one.output);
  if (!one.sequence.directory.empty()) {  // whose images are named
    for (const SequenceEntry& entry : sequence.index().entries) {
      RequireColmapTextName(ColmapImageName(sequence.index(), entry));
    }
  }
  MakeFolder(one.output);
}

}  // namespace

std::string CheckExportText(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) {
    return "'" + text + "' must be FORMAT=PATH, for instance tum=poses.txt";
  }
  const std::vector<std::string>& formats = ExportFormats();
  const std::string path = text.substr(equals + 1);
  if (std::find(formats.begin(), formats.end(), FormatOf(text)) != formats.end()) {
    return FormatOf(text) == "ply" ? CheckPlyFileName(path) : "";
  }
  return "'" + FormatOf(text) + "' is no format; formats: " + Joined(formats, ", ");
}

std::vector<RunExport> PlanExports(const ReplayArguments& arguments, const RgbdDecoder& sequence,
                                   const std::string& output, const std::string& session) {
  std::vector<RunExport> exports;
  for (const std::string& text : arguments.exports) {
    RunExport one;
    one.run = output;
    one.map = arguments.map.map;
    one.session = session;
    one.format = FormatOf(text);
    one.output = text.substr(text.find('=') + 1);
    const SequenceIndex& index = sequence.index();
    one.requires_features = false;
    one.overwrite = arguments.overwrite;
    // The images of a live camera are gone after the run.
    if (one.format == "mcap" && index.camera) one.map.clear();
    if (one.format != "colmap" || (!index.container && !index.camera && !index.scale_color)) {
      one.sequence = arguments.sequence;
      one.sequence.camera.clear();  // the calibration is that of the results
    }
    try {
      CheckBeforeRun(one, arguments, sequence);
    } catch (const std::exception& error) {
      throw std::runtime_error(NameOf(one) + ": " + error.what());
    }
    exports.push_back(one);
  }
  return exports;
}

bool WriteExports(const std::vector<RunExport>& exports) {
  bool are_written = true;
  for (auto one = exports.begin(); one != exports.end(); ++one) {
    try {
      WriteExport(*one);
    } catch (const Interrupted&) {
      std::string left;
      for (; one != exports.end(); ++one) left += " " + NameOf(*one);
      throw Interrupted("interrupted; not written:" + left + "; msc_vo export can write them");
    } catch (const std::exception& error) {
      PrintError(NameOf(*one) + ": " + error.what());
      are_written = false;
    }
  }
  return are_written;
}

}  // namespace msc_vo
