// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// Directions from which the report shows a trajectory.
struct TrajectoryView {
  /// Rotation with rows right, forward, up. Top view: (right, forward); side view: (right, up).
  Eigen::Matrix3d view_from_world = Eigen::Matrix3d::Identity();
  /// Whether up is the mean up direction of the cameras. Otherwise, if the cameras have no common
  /// up direction, it is the direction in which the trajectory extends least.
  bool up_from_cameras = true;
};

/// Right is the dominant horizontal direction of the trajectory (of the ground truth, if there is
/// any), with the sign of the first camera's right.
TrajectoryView ChooseTrajectoryView(const ReportData& data);

/// Mean over all frames of a direction given in the camera frame, in world. Its length measures how
/// well the directions agree (1: all equal).
Eigen::Vector3d MeanDirection(const ReportData& data, const Eigen::Vector3d& direction_in_cam);

}  // namespace msc_vo
