// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/manifold.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

// Manifold of the seven numbers of Rigid3: unit quaternion (x, y, z, w), then translation.
//
//   (q, t) + (w, u) = (Exp(w) q, t + u)
//
// w: rotation vector in the target frame (the camera's, for cam_from_world), radians; u: metres. So
// a covariance in this tangent has plain units. ceres::EigenQuaternionManifold is not used because
// its tangent is half the angle.
class Rigid3Manifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Map<const Eigen::Quaterniond> q(x);
    const Eigen::Map<const Eigen::Vector3d> t(x + 4), w(delta), u(delta + 3);
    Eigen::Map<Eigen::Quaterniond> q_plus(x_plus_delta);
    Eigen::Map<Eigen::Vector3d> t_plus(x_plus_delta + 4);
    // Normalised, so that rounding does not add up over many steps.
    q_plus = (ExpSO3(w) * q).normalized();
    t_plus = t + u;
    return true;
  }

  // d(Exp(w) q)/dw = 1/2 [q_w I - [q_v]x; -q_v^T] at w = 0, as Exp(w) = (w/2, 1) + O(|w|^2).
  bool PlusJacobian(const double* x, double* jacobian) const override {
    const Eigen::Map<const Eigen::Vector3d> v(x);
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> j(jacobian);
    j.setZero();
    j.topLeftCorner<3, 3>() = 0.5 * (x[3] * Eigen::Matrix3d::Identity() - Skew(v));
    j.block<1, 3>(3, 0) = -0.5 * v.transpose();
    j.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const Eigen::Map<const Eigen::Quaterniond> qy(y), qx(x);
    const Eigen::Map<const Eigen::Vector3d> ty(y + 4), tx(x + 4);
    Eigen::Map<Eigen::Vector3d> w(y_minus_x), u(y_minus_x + 3);
    w = LogSO3(qy * qx.conjugate());
    u = ty - tx;
    return true;
  }

  // dLog(q q_x^-1)/dq = 2 [q_w I + [q_v]x, -q_v] at q = q_x.
  bool MinusJacobian(const double* x, double* jacobian) const override {
    const Eigen::Map<const Eigen::Vector3d> v(x);
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobian);
    j.setZero();
    j.topLeftCorner<3, 3>() = 2.0 * (x[3] * Eigen::Matrix3d::Identity() + Skew(v));
    j.block<3, 1>(0, 3) = -2.0 * v;
    j.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }
};

}  // namespace msc_vo
