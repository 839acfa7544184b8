// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "tests/support/factor_checks.h"

#include "msc_vo/factors/unit_vector_manifold.h"

namespace msc_vo {

// Of a unit vector as a parameter block.
inline const UnitVectorManifold kUnitVectorManifold;

inline Eigen::Vector3d AnyDirection(RandomGeometry* random) {
  return random->Normal3().normalized();
}

}  // namespace msc_vo
