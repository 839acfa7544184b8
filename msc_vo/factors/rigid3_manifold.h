// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/rotation3_manifold.h"

namespace msc_vo {

/// Manifold of the parameters of Rigid3: unit quaternion (x, y, z, w), then translation.
///
///   (q, t) + (w, u) = (Exp(w) q, t + u)
///
/// w: rotation vector in the target frame (the camera frame of cam_from_world), radians. u: metres.
/// The tangent of ceres::EigenQuaternionManifold is half the rotation angle, which would put
/// covariances in half radians.
class Rigid3Manifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Map<const Eigen::Vector3d> t(x + 4), u(delta + 3);
    Eigen::Map<Eigen::Vector3d> t_plus(x_plus_delta + 4);
    t_plus = t + u;
    return Rotation3Manifold().Plus(x, delta, x_plus_delta);
  }

  bool PlusJacobian(const double* x, double* jacobian) const override {
    Eigen::Matrix<double, 4, 3, Eigen::RowMajor> rotation;
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> j(jacobian);
    j.setZero();
    Rotation3Manifold().PlusJacobian(x, rotation.data());
    j.topLeftCorner<4, 3>() = rotation;
    j.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const Eigen::Map<const Eigen::Vector3d> ty(y + 4), tx(x + 4);
    Eigen::Map<Eigen::Vector3d> u(y_minus_x + 3);
    u = ty - tx;
    return Rotation3Manifold().Minus(y, x, y_minus_x);
  }

  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rotation;
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobian);
    j.setZero();
    Rotation3Manifold().MinusJacobian(x, rotation.data());
    j.topLeftCorner<3, 4>() = rotation;
    j.bottomRightCorner<3, 3>().setIdentity();
    return true;
  }
};

}  // namespace msc_vo
