// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// First line of a camera file, for messages.
inline constexpr char kCameraFileFormat[] =
    "'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]'";

/// Reads camera.txt: one line 'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]' with the
/// distortion in OpenCV's order, and an optional second line 'readout_time SECONDS'. Comments start
/// with #. Throws std::runtime_error naming file, line and fix.
Calibration ReadCameraFile(const std::string& path);

}  // namespace msc_vo
