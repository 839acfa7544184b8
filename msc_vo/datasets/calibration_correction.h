// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// Returns the calibration with a correction applied. Corrections of the depth registration become
/// a depth camera, or change the one that there is; those of the depth sensor (kDepthOffset,
/// kDepthBowl) are left out.
Calibration Corrected(const Calibration& calibration, const SensorCorrection::Vector& correction);

/// The same for intrinsics that have been corrected.
Calibration Corrected(const Calibration& calibration, const CameraIntrinsics& intrinsics);

}  // namespace msc_vo
