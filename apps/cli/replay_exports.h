// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "apps/cli/replay_arguments.h"
#include "apps/cli/run_export.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Describes what is wrong with a FORMAT=PATH of --export; empty if it is right.
std::string CheckExportText(const std::string& text);

/// The exports that a run shall write at its end from its results in `output` and its session in
/// the map (NewSessionName()). Throws std::runtime_error that names the export and the fix if one
/// cannot be written.
std::vector<RunExport> PlanExports(const ReplayArguments& arguments, const RgbdDecoder& sequence,
                                   const std::string& output, const std::string& session);

/// Writes exports. Continues after a failed export and prints its error. Returns whether all are
/// written. Throws Interrupted, which names those that are not.
bool WriteExports(const std::vector<RunExport>& exports);

}  // namespace msc_vo
