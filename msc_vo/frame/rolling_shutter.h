// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/camera_velocity.h"

namespace msc_vo {

// Rolling-shutter compensation. A rolling shutter exposes the rows of an image one after the other:
// each at the time stamp plus its phase times the readout time, which is the time in seconds from
// the first row to the last, negative if the last row is read first. A Kinect's is 26 ms: at 70
// degrees per second the last row is shifted by 17 pixels relative to the first, and no single pose
// explains the image.

/// Phase of a pixel's row: -0.5 at the upper border of the image, 0.5 at the lower one. Lens
/// distortion is neglected: a displacement of 10 rows is an error of 2 % of the readout time.
double RowPhase(const PinholeCamera& camera, const Eigen::Vector2d& pixel);

/// Phase of the row that a feature of the frame was recorded in; the same, unless the frame has a
/// lens.
double RowPhase(const Frame& frame, const Eigen::Vector2d& pixel);

/// Derivative (1/seconds) of the ray of a feature (z = 1) with the given inverse depth (1/metres)
/// with respect to the readout time of the compensation. Zero if the velocity is unknown.
Eigen::Vector3d RayChange(const Frame& frame, const Eigen::Vector2d& pixel, double inverse_depth);

/// Returns the frame as a global shutter would have recorded it at its time stamp: pixels and
/// depths are moved by the camera's motion between the time stamp and the time of their row.
/// Features without a depth move as if at infinity. For a frame that was compensated before, the
/// difference is applied with the phases of the compensated pixels: a few rows off, so that some
/// percent of the difference remain.
Frame CompensateRollingShutter(const Frame& frame, const CameraVelocity& velocity,
                               double readout_time);

/// Moves the planes of a frame, whose depth image was taken at another time than its colour image,
/// to the time stamp with another velocity than before (Frame::depth_motion). Covariances and hulls
/// stay. No effect if both images were taken at the same time.
void SetDepthVelocity(const CameraVelocity& velocity, Frame* frame);

}  // namespace msc_vo
