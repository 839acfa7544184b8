// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/product_manifold.h>

#include "msc_vo/factors/unit_vector_manifold.h"

namespace msc_vo {

/// Manifold of the parameters of a Plane: a unit normal and an offset. Its tangent consists of the
/// angles of UnitVectorManifold (radians), then the offset (metres).
using PlaneManifold = ceres::ProductManifold<UnitVectorManifold, ceres::EuclideanManifold<1>>;

}  // namespace msc_vo
