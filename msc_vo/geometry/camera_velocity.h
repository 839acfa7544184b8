// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

// How what stands still moves as seen by a camera, in its own frame.
struct CameraVelocity {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // radians/second
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // metres/second

  // From the camera's frame now to that in so many seconds, or before, if negative.
  Rigid3 Over(double seconds) const { return {ExpSO3(seconds * angular), seconds * linear}; }
};

}  // namespace msc_vo
