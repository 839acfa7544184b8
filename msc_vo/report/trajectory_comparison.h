// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/report/plot_page.h"

namespace msc_vo {

/// An estimated trajectory beside its reference, as plain data. Both have the same number of poses,
/// matched by time and in order of it; the estimate is aligned.
struct TrajectoryComparison {
  std::string title;
  std::string command_line;
  std::vector<ReportNumber> numbers;  ///< shown above the plots
  std::vector<TimedPose> reference;
  std::vector<TimedPose> estimate;
  std::vector<double> ape;  ///< metres, of each pose
  double ape_rmse = 0.0;    ///< metres
  double ape_mean = 0.0;    ///< metres
  double ape_median = 0.0;  ///< metres
  bool has_stamps = true;   ///< otherwise the time stamp of a pose is its index
};

/// The numbers; the trajectories in the planes xy, xz and yz; x, y, z, roll, pitch, yaw (in the
/// order Rz Ry Rx, degrees) and the APE over time.
PlotPage ComparisonPage(const TrajectoryComparison& comparison);

/// Roll, pitch and yaw of a rotation R = Rz(yaw) Ry(pitch) Rx(roll), degrees.
Eigen::Vector3d RollPitchYaw(const Eigen::Quaterniond& rotation);

}  // namespace msc_vo
