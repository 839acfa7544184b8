// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

/// Evidence for an axis: the direction of a 3-D line or the normal of a surface, in a frame of the
/// caller's choice.
struct AxisEvidence {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit; its sign is arbitrary
  double sigma = DegreesToRadians(1.0);                  ///< radians, of each of its two components
};

}  // namespace msc_vo
