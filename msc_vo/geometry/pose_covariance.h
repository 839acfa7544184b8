// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Covariance of a pose b_from_a in the tangent of Rigid3Manifold: rotation vector in frame b
/// (radians), then translation (metres).
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// Independent errors of equal standard deviations: of the rotation vector (radians) and of the
/// translation (metres).
PoseCovariance IsotropicCovariance(double rotation_sigma, double translation_sigma);

/// Covariance of c_from_a = c_from_b * b_from_a, whose factors have independent errors.
PoseCovariance ComposeCovariances(const Rigid3& c_from_b, const PoseCovariance& covariance_c_from_b,
                                  const Rigid3& b_from_a,
                                  const PoseCovariance& covariance_b_from_a);

/// Covariance of the camera itself, both parts in the camera frame: rotation vector, then the
/// camera's position. The translation of cam_from_world is the position of the world's origin
/// instead, on which the rotation acts with a lever arm.
PoseCovariance CameraCovariance(const Rigid3& cam_from_world, const PoseCovariance& covariance);
/// The inverse of CameraCovariance(): the covariance of cam_from_world.
PoseCovariance CovarianceOfCamera(const Rigid3& cam_from_world, const PoseCovariance& camera);

/// Covariance of a motion in frame b (rotation vector, then translation), given that in frame a.
PoseCovariance TransportCovariance(const Rigid3& b_from_a, const PoseCovariance& covariance);

}  // namespace msc_vo
