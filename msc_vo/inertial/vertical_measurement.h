// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/timed_acceleration.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// The vertical at one pose of a trajectory.
struct VerticalMeasurement {
  size_t pose = 0;  ///< index of the pose
  /// Upward reaction to gravity, metres/second^2, in the camera of the pose: the mean reading of
  /// the accelerometer minus the acceleration of the camera. Its length differs from that of
  /// gravity by the errors of both.
  Eigen::Vector3d up_in_cam = Eigen::Vector3d::Zero();
  /// Part of the readings that it does not share with the measurements at the neighbouring poses,
  /// above 0, at most 1.
  double independence = 1.0;
};

/// Measures the vertical at the poses i of a trajectory that have earlier and later ones at a
/// distance of `min_interval` to three times as many seconds. With the nearest such poses h and j,
/// positions p, and the weight b(t) that is 1 at t_i and decreases linearly to 0 at t_h and t_j,
///
///   int b(t) p''(t) dt = (p_j - p_i) / (t_j - t_i) - (p_i - p_h) / (t_i - t_h)
///
/// holds exactly, so that the motion of the camera is subtracted without differentiating twice. The
/// readings are weighted with b and rotated to the world by the interpolated rotation.
/// `readings`: in the axes of the camera, in order of time. `poses`: in order of time. Poses during
/// which readings are missing get no measurement.
std::vector<VerticalMeasurement> MeasureVertical(const std::vector<TimedAcceleration>& readings,
                                                 const std::vector<TimedPose>& poses,
                                                 double min_interval);

}  // namespace msc_vo
