// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

// Derivative of the distorted point of the plane z = 1 by the ideal one `x`; symmetric.
Eigen::Matrix2d DistortionJacobian(const LensDistortion& distortion, const Eigen::Vector2d& x);

// Whether the lens maps the ideal image and everything that the recorded image shows one to one.
//
// The distortion x -> x_d of the plane z = 1 is the gradient of a potential, so its Jacobian is
// symmetric; where it is positive definite on a convex set, the distortion is injective there. The
// set is a disc around the optical axis, grown until it holds the ideal image and its distorted
// border holds the recorded one. A lens whose Jacobian loses definiteness before folds over:
// recorded pixels near the corners have no ideal pixel, or two.
//
// The camera must be valid. On false, `error` names the radius and the order of the coefficients.
bool IsInvertible(const LensDistortion& distortion, const PinholeCamera& camera,
                  std::string* error);

}  // namespace msc_vo
