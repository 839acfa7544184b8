// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// First line of a camera file, for messages.
inline constexpr char kCameraFileFormat[] =
    "'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]'";

/// Line of a camera file that describes a depth camera, for messages.
inline constexpr char kDepthCameraFormat[] =
    "'depth_camera fx fy cx cy width height tx ty tz [qx qy qz qw]'";

/// Reads camera.txt: one line 'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]' with the
/// distortion in OpenCV's order, and optional lines after it, in any order: 'readout_time
/// SECONDS' and 'depth_camera fx fy cx cy width height tx ty tz [qx qy qz qw]', the camera of depth
/// images that are not registered and its transform depth_from_color (metres; without a quaternion,
/// the axes are parallel). Further optional lines are 'lens MODEL COEFFICIENTS' instead of the
/// distortion of the first line, 'field_of_view DEGREES' of the undistorted images, 'depth_lens
/// MODEL COEFFICIENTS' and 'inverse_depth_offset 1/METRES' for the depth camera, see
/// LensModelName(), LensCoefficientNames(), DepthCamera; and 'depth_sensor NAME', see DepthSensor.
/// Comments start with #. Throws std::runtime_error naming file, line and fix.
Calibration ReadCameraFile(const std::string& path);

/// The text of camera.txt, with a comment line.
std::string FormatCameraFile(const Calibration& calibration, const std::string& comment);

}  // namespace msc_vo
