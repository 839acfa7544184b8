// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/line_direction.h"

namespace msc_vo {

/// Alignment of a line with a Manhattan axis (paper: E_parallel(j, M_j) in the local map
/// optimisation), 2 rows:
///
///   r = (e_1 . d, e_2 . d) / sigma,   d = (E - S) / |E - S|
///
/// S, E: end points in the world, metres (block 0, 6). e_1, e_2: unit vectors that complete the
/// axis m to an orthonormal basis. sigma: radians, of each component of the angle. |r| sigma is the
/// sine of the angle, as for ParallelLines; two rows suffice here because the axis is constant. The
/// residual is smooth everywhere and its norm does not depend on the sign of d.
class ManhattanAxisAlignment : public WindowFactor<ManhattanAxisAlignment, 2, BlockKind::kLine> {
 public:
  /// `axis`: m, a unit vector in the world.
  ManhattanAxisAlignment(const Eigen::Vector3d& axis, double sigma)
      : e1_(axis.unitOrthogonal()), e2_(axis.cross(e1_)), inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* line, T* residuals) const {
    Eigen::Matrix<T, 3, 1> d;
    if (!LineDirection(line, &d)) return false;
    Residual(d, residuals);
    return true;
  }

  /// The rows as a function of the unit direction d, and their derivative.
  template <typename T>
  void Residual(const Eigen::Matrix<T, 3, 1>& d, T* r) const {
    r[0] = (d.x() * e1_.x() + d.y() * e1_.y() + d.z() * e1_.z()) * inverse_sigma_;
    r[1] = (d.x() * e2_.x() + d.y() * e2_.y() + d.z() * e2_.z()) * inverse_sigma_;
  }
  Eigen::Matrix<double, 2, 3> Jacobian() const {
    Eigen::Matrix<double, 2, 3> j;
    j << e1_.transpose(), e2_.transpose();
    return inverse_sigma_ * j;
  }

 private:
  Eigen::Vector3d e1_, e2_;
  double inverse_sigma_;  // 1/radians
};

}  // namespace msc_vo
