// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "tests/support/factor_checks.h"
#include <ceres/sphere_manifold.h>

namespace msc_vo {

// Of a unit vector as a parameter block.
inline const ceres::SphereManifold<3> kSphere;

inline Eigen::Vector3d AnyDirection(RandomGeometry* random) {
  return random->Normal3().normalized();
}

}  // namespace msc_vo
