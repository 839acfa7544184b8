// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/version.h>

#if CERES_VERSION_MAJOR < 2 || (CERES_VERSION_MAJOR == 2 && CERES_VERSION_MINOR < 1)
#error "msc_vo needs Ceres 2.1 or later, which has ceres::Manifold"
#endif

#include <ceres/manifold.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Manifold of a rotation as a unit quaternion (x, y, z, w):
///
///   q + w = Exp(w) q
///
/// w: rotation vector in the target frame, radians (the full angle, as in Rigid3Manifold).
class Rotation3Manifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 4; }
  int TangentSize() const override { return 3; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Map<const Eigen::Quaterniond> q(x);
    const Eigen::Map<const Eigen::Vector3d> w(delta);
    Eigen::Map<Eigen::Quaterniond> q_plus(x_plus_delta);
    // Normalised so that rounding errors do not accumulate over many steps.
    q_plus = (ExpSO3(w) * q).normalized();
    return true;
  }

  /// d(Exp(w) q)/dw = 1/2 [q_w I - [q_v]x; -q_v^T] at w = 0, as Exp(w) = (w/2, 1) + O(|w|^2).
  bool PlusJacobian(const double* x, double* jacobian) const override {
    const Eigen::Map<const Eigen::Vector3d> v(x);
    Eigen::Map<Eigen::Matrix<double, 4, 3, Eigen::RowMajor>> j(jacobian);
    j.topRows<3>() = 0.5 * (x[3] * Eigen::Matrix3d::Identity() - Skew(v));
    j.row(3) = -0.5 * v.transpose();
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const Eigen::Map<const Eigen::Quaterniond> qy(y), qx(x);
    Eigen::Map<Eigen::Vector3d> w(y_minus_x);
    w = LogSO3(qy * qx.conjugate());
    return true;
  }

  /// dLog(q q_x^-1)/dq = 2 [q_w I + [q_v]x, -q_v] at q = q_x.
  bool MinusJacobian(const double* x, double* jacobian) const override {
    const Eigen::Map<const Eigen::Vector3d> v(x);
    Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> j(jacobian);
    j.leftCols<3>() = 2.0 * (x[3] * Eigen::Matrix3d::Identity() + Skew(v));
    j.col(3) = -2.0 * v;
    return true;
  }
};

}  // namespace msc_vo
