// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/product_manifold.h>

#include "msc_vo/factors/rotation3_manifold.h"

namespace msc_vo {

/// Manifold of the parameters of Rigid3: unit quaternion (x, y, z, w), then translation.
///
///   (q, t) + (w, u) = (Exp(w) q, t + u)
///
/// w: rotation vector in the target frame (the camera frame of cam_from_world), radians. u: metres.
/// The tangent of ceres::EigenQuaternionManifold is half the rotation angle, which would put
/// covariances in half radians.
using Rigid3Manifold = ceres::ProductManifold<Rotation3Manifold, ceres::EuclideanManifold<3>>;

}  // namespace msc_vo
