// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/product_manifold.h>
#include <ceres/sphere_manifold.h>

namespace msc_vo {

/// Manifold of the parameters of a Plane: a unit normal and an offset, three dimensions.
using PlaneManifold = ceres::ProductManifold<ceres::SphereManifold<3>, ceres::EuclideanManifold<1>>;

}  // namespace msc_vo
