// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// Formats a calibration as an object of JSON with every digit: fx, fy, cx, cy (pixels), width and
/// height of the undistorted images, lens (LensModelName()), distortion (in the order of
/// LensCoefficientNames()), `recorded`, the same of the recorded images if that is another camera,
/// depth_scale, and depth_camera if there is one. Readout time and the sources of the values are
/// left out.
std::string FormatCalibrationJson(const Calibration& calibration);

/// Reads the result of FormatCalibrationJson(). Throws std::runtime_error that names the value that
/// is missing or invalid.
Calibration ParseCalibrationJson(const std::string& text);

}  // namespace msc_vo
