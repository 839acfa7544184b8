// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/geometry/timed_acceleration.h"

namespace msc_vo {

/// Reads accelerometer.txt in the folder of a sequence, TUM's "time ax ay az" rows in any order
/// (metres/second^2, gravity included, in the axes of the sensor). Converts stamps in milliseconds,
/// microseconds or nanoseconds to seconds, with the images as reference. Returns the readings in
/// order of time.
/// Throws std::runtime_error naming file, line and fix if the file does not exist or a row is
/// malformed, if there is no reading during the images, or if the median length of the readings
/// differs from gravity by more than 20 %.
std::vector<TimedAcceleration> ReadAccelerometer(const SequenceIndex& index);

/// Rotation of the axes of an accelerometer to those of the camera (x to the right, y downwards, z
/// forwards). `axes` names the camera axes of the sensor's x, y and z axis: "x,y,z" is the
/// identity, "-x,-y,z" a sensor whose x axis points to the left and whose y axis points upwards.
/// Throws std::invalid_argument that names the fix if it is not a right-handed set of axes.
Eigen::Matrix3d RotationFromAxes(const std::string& axes);

}  // namespace msc_vo
