// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

// Whether a text is a settings file of ORB-SLAM2, ORB-SLAM3 or a relative: flat 'Camera.fx: 517.3'
// lines, which are nearly but not quite YAML.
bool IsOrbSlamConfig(const std::string& content);

// The camera of such a file: Camera.fx (or Camera1.fx) ... Camera.k3, Camera.width and .height if
// given, DepthMapFactor (or RGBD.DepthMapFactor). Everything else, and every malformed line, is
// passed over. Camera.type may be PinHole or Rectified; the images of the latter have no
// distortion. Throws std::runtime_error naming the file, and the line of a bad value, if the camera
// is not there, is of another type, or has more coefficients than k1 k2 p1 p2 k3.
CameraSettings ReadOrbSlamConfig(const std::string& path);

}  // namespace msc_vo
