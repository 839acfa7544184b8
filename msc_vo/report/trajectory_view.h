// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// From which side a trajectory is looked at.
struct TrajectoryView {
  /// Rows: right, forward, up; a rotation. Top view: (right, forward); side view: (right, up).
  Eigen::Matrix3d view_from_world = Eigen::Matrix3d::Identity();
  /// How `up` was found: the mean up direction of the cameras, or, where those disagree, the
  /// direction in which the trajectory extends least.
  bool up_from_cameras = true;
};

/// Right is the dominant direction of the trajectory (truth if there is one) across up, signed as
/// the first camera's right. The same data give the same view.
TrajectoryView ChooseTrajectoryView(const ReportData& data);

}  // namespace msc_vo
