// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// Prior on a direction (not in the paper), 2 rows:
///
///   r = 2 (e_1 . d, e_2 . d) / (1 + m . d) / sigma
///
/// d: unit vector (block 0, 3, with UnitVectorManifold). m: mean of the prior. e_1, e_2: unit
/// vectors that complete m to an orthonormal basis. sigma: radians, of each component of the angle.
/// With the angle a between d and m, |r| sigma = 2 tan(a / 2), which grows up to 180 degrees, where
/// the factor is undefined and returns false.
class DirectionPrior : public CostFunctor<DirectionPrior, 2, 3> {
 public:
  /// `mean`: m, of any length but zero.
  DirectionPrior(const Eigen::Vector3d& mean, double sigma)
      : m_(mean.normalized()),
        e1_(m_.unitOrthogonal()),
        e2_(m_.cross(e1_)),
        inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* direction, T* residuals) const {
    const T denominator = 1.0 + Dot(m_, direction);
    if (!(denominator > 1e-12)) return false;
    const T factor = 2.0 * inverse_sigma_ / denominator;
    residuals[0] = factor * Dot(e1_, direction);
    residuals[1] = factor * Dot(e2_, direction);
    return true;
  }

 private:
  template <typename T>
  static T Dot(const Eigen::Vector3d& a, const T* b) {
    return a.x() * b[0] + a.y() * b[1] + a.z() * b[2];
  }

  Eigen::Vector3d m_, e1_, e2_;
  double inverse_sigma_;  // 1/radians
};

}  // namespace msc_vo
