// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

namespace msc_vo {

/// One reading of an accelerometer. At rest it points up and has the length of gravity.
struct TimedAcceleration {
  double timestamp = 0.0;                                  ///< seconds
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< metres/second^2, gravity included
};

}  // namespace msc_vo
