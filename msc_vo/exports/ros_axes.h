// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// The axes of ROS (REP 103): x forward, y left, z up, for the map, the odometry and the camera.
// Those of msc_vo, x right, y down, z forward, are those of the optical frame of a camera.

/// Turns vectors of a frame with the axes of msc_vo into the same frame with the axes of ROS.
Eigen::Quaterniond RosFromOptical();

/// The same for a vector, to the last bit.
Eigen::Vector3d WithRosAxes(const Eigen::Vector3d& x);

/// The same pose b_from_a of frames with the axes of ROS, to the last bit.
Rigid3 WithRosAxes(const Rigid3& b_from_a);

/// Covariance of a pose as ROS has it: position (metres), then rotation about fixed axes (radians),
/// both in the frame that the pose is given in, row by row.
using RosCovariance = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// The covariance of a camera in a frame with the axes of ROS. `frame_from_cam`: rotation from the
/// optical frame into that frame with the axes of msc_vo; `camera`: see CameraCovariance().
RosCovariance CovarianceWithRosAxes(const Eigen::Quaterniond& frame_from_cam,
                                    const PoseCovariance& camera);

}  // namespace msc_vo
