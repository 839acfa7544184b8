// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// The camera of a published data set.
struct CameraPreset {
  std::string name;
  Calibration calibration;
};

/// Returns all presets, in the order in which messages list them.
const std::vector<CameraPreset>& CameraPresets();

/// Returns the preset of this name. Throws std::invalid_argument, listing the known names, if it is
/// unknown.
const CameraPreset& FindCameraPreset(const std::string& name);

/// Guesses the preset from the name of a sequence's folder ("rgbd_dataset_freiburg2_xyz" ->
/// "tum-fr2"); empty if the name matches none.
std::string GuessCameraPreset(const std::string& directory);

/// Tests whether the name of a folder is that of a sequence whose camera is known: one of TUM
/// RGB-D, or of 7-Scenes in the folder of its scene ("chess/seq-01").
bool HasPublishedName(const std::string& directory);

}  // namespace msc_vo
