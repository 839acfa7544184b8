// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/plane_manifold.h"
#include "msc_vo/geometry/plane.h"

namespace msc_vo {

// Of a plane as a parameter block.
inline const PlaneManifold kPlaneManifold;

inline std::vector<double> Block(const Plane& plane) {
  return {plane.params.data(), plane.params.data() + 4};
}

// A plane of any direction, about one metre from the origin.
inline Plane RandomPlane(RandomGeometry* random) {
  const Eigen::Vector3d normal = random->Normal3().normalized();
  return {normal, random->Normal()};
}

}  // namespace msc_vo
