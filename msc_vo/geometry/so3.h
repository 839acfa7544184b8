// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace msc_vo {

/// Cross-product matrix [v]x: Skew(v) * w = v x w.
Eigen::Matrix3d Skew(const Eigen::Vector3d& v);

/// Rotation by |w| radians about w / |w|.
Eigen::Quaterniond ExpSO3(const Eigen::Vector3d& w);

/// Rotation vector w (radians, |w| <= pi) with ExpSO3(w) == q up to sign.
Eigen::Vector3d LogSO3(const Eigen::Quaterniond& q);

/// Inverse left Jacobian: LogSO3(ExpSO3(d) ExpSO3(w)) = w + J_l^-1(w) d to first order in d, for
/// |w| < 2 pi.
Eigen::Matrix3d InverseLeftJacobianSO3(const Eigen::Vector3d& w);

}  // namespace msc_vo
