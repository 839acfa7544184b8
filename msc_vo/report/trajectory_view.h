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

}  // namespace msc_vo
