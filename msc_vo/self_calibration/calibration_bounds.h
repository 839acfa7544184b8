// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/camera/camera_intrinsics.h"

namespace msc_vo {

/// Names what no RGB-D camera has whose description is `given`, with errors as descriptions have
/// them: "the focal length would be 2.28 times the given one". Empty if there can be such a camera.
/// A correction beyond these bounds does not correct a calibration: depth images hold no depth, or
/// do not belong to the colour images.
///
/// - Focal length: within a factor of 1.5 of the given one, beyond which it is that of another
/// image
///   size, and a horizontal field of view from 35 to 110 degrees.
/// - Principal point: within 15 % of the image size from the middle; lenses are centred to a few
///   per cent.
/// - Lens: one-to-one, see IsInvertible(), and at no corner of the recorded image more than 15 %
///   farther from the axis than without distortion; that of a Kinect: 6 %.
/// - Depth images: magnified by at most 1.65, as those of a sensor with a view of 87 degrees beside
///   a colour camera with 60; shifted by 0.1 focal lengths, and turned by 5 degrees, the largest
///   errors of a mount; 15 cm between the cameras.
/// - Inverse depth: an offset of 0.05 1/m, four times that of structured-light cameras, and 25 % at
///   45 degrees from the axis, five times that of these; the length of viewing rays has 50 %.
///
/// A given camera that exceeds an absolute bound raises it.
std::string DescribeImplausible(const CameraIntrinsics& given,
                                const SensorCorrection::Vector& correction);

}  // namespace msc_vo
