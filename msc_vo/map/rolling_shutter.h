// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/map/frame.h"

namespace msc_vo {

// A rolling shutter takes the rows of an image one after the other, each at the time stamp plus its
// phase times the readout time: the seconds from the first row to the last, negative if the last
// comes first. A Kinect's are 26 ms: at the 70 degrees per second of TUM's freiburg1_rpy the last
// row is shifted by 17 pixels against the first, and no pose explains what the image shows.

// Of the row of a pixel: -0.5 before the first, 0.5 after the last. Distortion is left out: where a
// lens bends the image by 10 rows, that is 2 % of the readout time.
double RowPhase(const PinholeCamera& camera, const Eigen::Vector2d& pixel);

// How the ray of a feature (z = 1) with an inverse depth (1/metres) changes with the readout time
// that the frame is unrolled with, 1/seconds, to first order. Zero if the velocity is not known.
Eigen::Vector3d RayChange(const Frame& frame, const Eigen::Vector2d& pixel, double inverse_depth);

// The frame as a global shutter would have seen it at its time stamp: pixels and depths moved as
// the camera moved between that and the time of their row. Features without a depth move as if far
// away. Of a frame that was unrolled before the difference is applied, with the phases of its
// pixels as they are: these are some rows off, so that some percent of the difference remain.
Frame CompensateRollingShutter(const Frame& rolled, const CameraVelocity& velocity,
                               double readout_time);

}  // namespace msc_vo
