// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/sphere_manifold.h>

namespace msc_vo {

/// Manifold of a unit vector in three dimensions, with angles as its tangent:
///
///   x + w = cos(|w|) x + sin(|w|) / |w| (w_1 e_1 + w_2 e_2)
///
/// w: radians. e_1, e_2: unit vectors that complete x to an orthonormal basis, those of
/// ceres::SphereManifold, whose own tangent is twice the angle in Ceres 2.1 and the angle in later
/// versions.
class UnitVectorManifold final : public ceres::Manifold {
 public:
  UnitVectorManifold() {
    const double z[] = {0.0, 0.0, 1.0};
    double jacobian[6];
    sphere_.PlusJacobian(z, jacobian);
    per_radian_ = 1.0 / jacobian[0];
  }

  int AmbientSize() const override { return 3; }
  int TangentSize() const override { return 2; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const double scaled[] = {per_radian_ * delta[0], per_radian_ * delta[1]};
    return sphere_.Plus(x, scaled, x_plus_delta);
  }

  bool PlusJacobian(const double* x, double* jacobian) const override {
    const bool is_defined = sphere_.PlusJacobian(x, jacobian);
    for (int i = 0; i < 6; ++i) jacobian[i] *= per_radian_;
    return is_defined;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const bool is_defined = sphere_.Minus(y, x, y_minus_x);
    for (int i = 0; i < 2; ++i) y_minus_x[i] /= per_radian_;
    return is_defined;
  }

  bool MinusJacobian(const double* x, double* jacobian) const override {
    const bool is_defined = sphere_.MinusJacobian(x, jacobian);
    for (int i = 0; i < 6; ++i) jacobian[i] /= per_radian_;
    return is_defined;
  }

 private:
  ceres::SphereManifold<3> sphere_;
  double per_radian_;  // tangent of sphere_ per radian: 2 or 1
};

}  // namespace msc_vo
