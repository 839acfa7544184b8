// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// Whether a text is a settings file of ORB-SLAM2, ORB-SLAM3 or a system derived from them: flat
/// 'Camera.fx: 517.3' lines, which are not always valid YAML.
bool IsOrbSlamConfig(const std::string& content);

/// Reads the camera of such a file: Camera.fx (or Camera1.fx) to Camera.k3, Camera.width and
/// Camera.height if given, and DepthMapFactor (or RGBD.DepthMapFactor). Other keys and malformed
/// lines are ignored. Camera.type is PinHole, Rectified for images without distortion, or
/// KannalaBrandt8 for a fisheye lens with k1 to k4. Throws std::runtime_error naming the file, and
/// the line of an invalid value, if the camera is missing, is of another type, or is a pinhole
/// camera with other distortion coefficients than k1 k2 p1 p2 k3.
CameraSettings ReadOrbSlamConfig(const std::string& path);

}  // namespace msc_vo
