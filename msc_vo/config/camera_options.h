// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// Returns the options that give all values of a calibration: the section `camera`,
/// `mapping.readout_time` if the readout time is known, and `features.depth_sensor` if the sensor
/// is given. All others have their defaults.
Configuration CameraConfiguration(const Calibration& calibration);

/// Reads a camera over that of `configuration`: the section `camera`, `mapping.readout_time` and
/// `features.depth_sensor` of a file for ReadConfiguration(), or a file for ReadCameraFile(). The
/// section `camera` is replaced as a whole; other options of the file are not read. Throws
/// std::runtime_error naming the file, also if it describes no camera.
void ReadCamera(const std::string& path, Configuration* configuration);

/// Describes the first value in which two calibrations differ, "camera.fx is 520 instead of 525";
/// empty if they are equal.
std::string DescribeDifference(const Calibration& calibration, const Calibration& expected);

}  // namespace msc_vo
