// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/cli/synthesize_arguments.h"
#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// Calibration of the cameras that record a sequence of these options: intrinsics and lens of the
/// recorded images, depth camera, depth scale (of true depth) and readout time.
Calibration TrueCalibration(const SyntheticSequenceOptions& options,
                            const SyntheticSequence& sequence);

/// What camera.txt says instead of `truth`. Throws UsageError if that is no camera.
Calibration GivenCalibration(const SynthesizeArguments& arguments, const Calibration& truth);

/// Intrinsics and lens of the recorded images, and the rest of a calibration. `depth_camera` and
/// `readout_time` are null if there is none.
nlohmann::ordered_json CalibrationToJson(const Calibration& calibration);

/// Text of truth.json: the true calibration, what camera.txt says, the errors of the images, and
/// the options of the command.
std::string FormatTruthJson(const SynthesizeArguments& arguments,
                            const SyntheticSequenceOptions& options, const Calibration& truth,
                            const Calibration& given);

}  // namespace msc_vo
