// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Apparent motion of the static scene in the camera frame.
struct CameraVelocity {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< radians/second
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< metres/second

  /// Mean velocity of a motion `cam_from_last` that took `seconds`, which must not be 0.
  static CameraVelocity Of(const Rigid3& cam_from_last, double seconds) {
    return {LogSO3(cam_from_last.rotation()) / seconds, cam_from_last.translation() / seconds};
  }

  /// Transform from the present camera frame to that after `seconds`, which may be negative.
  Rigid3 Over(double seconds) const { return {ExpSO3(seconds * angular), seconds * linear}; }
};

}  // namespace msc_vo
