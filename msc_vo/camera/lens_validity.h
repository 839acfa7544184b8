// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

/// Tests whether the distortion is one-to-one on the undistorted image and on everything that the
/// recorded image shows. If not, `error` names the radius where the lens folds over and the order
/// of the coefficients. The camera must be valid.
///
/// The distortion x -> x_d of the plane z = 1 is the gradient of a potential, so its Jacobian is
/// symmetric; on a convex set where it is positive definite, the distortion is injective. The set
/// tested is a disc around the optical axis, grown until it contains the undistorted image and its
/// distorted boundary encloses the recorded image. If the Jacobian is not positive definite on this
/// disc, recorded pixels near the corners have no undistorted pixel, or two. If the lens is cropped
/// (LensDistortion::IsCropped), the disc only needs to contain the undistorted image.
bool IsInvertible(const LensDistortion& distortion, const PinholeCamera& camera,
                  std::string* error);

}  // namespace msc_vo
