// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "apps/cli/run_export.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// The trajectory of a folder of results, or the file itself.
std::string TrajectoryPath(const std::string& run);

/// Opens the sequence of an export with the calibration at the end of the run, unless the arguments
/// name one. Throws std::runtime_error, naming the results, if these do not say of which sequence
/// they are.
RgbdDecoder OpenExportedSequence(const RunExport& arguments);

/// Throws std::runtime_error, naming the fix, if the images of a sequence are not files that
/// another program can read with the calibration of the sequence.
void RequireImageFiles(const RgbdDecoder& decoder);

}  // namespace msc_vo
