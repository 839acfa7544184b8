// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/diagnosis/motion_calibration.h"

namespace msc_vo {

/// Reports a warning for each part of the calibration that is wrong by the evidence of the images,
/// with its estimate. Values are those of the recorded images.
void AddCalibrationFindings(const Calibration& given, const MotionCalibration& calibration,
                            Findings* findings);

}  // namespace msc_vo
