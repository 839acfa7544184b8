// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

// A camera of a published data set.
struct CameraPreset {
  std::string name;
  Calibration calibration;
};

const std::vector<CameraPreset>& CameraPresets();

// Throws std::invalid_argument, listing the names, on an unknown one.
const CameraPreset& FindCameraPreset(const std::string& name);

// The preset whose data set a folder seems to belong to by its name ("rgbd_dataset_freiburg2_xyz"
// -> "tum-fr2"); empty: none.
std::string GuessCameraPreset(const std::string& directory);

}  // namespace msc_vo
