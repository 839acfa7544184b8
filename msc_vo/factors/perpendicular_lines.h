// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/line_pair_factor.h"

namespace msc_vo {

/// Perpendicular lines (paper Eq. perp_error), 1 row:
///
///   r = d_i . d_j / sigma,   d = (E - S) / |E - S|
///
/// S, E: end points in the world, metres (blocks 0 and 1, 6 each). sigma: radians, of the angle
/// between the lines. The residual is signed: the paper's absolute value has the same square but no
/// derivative at zero. The order of end points changes at most the sign of r.
class PerpendicularLines : public LinePairFactor<PerpendicularLines, 1> {
 public:
  using LinePairFactor::LinePairFactor;

  template <typename T>
  void Residual(const Eigen::Matrix<T, 3, 1>& d_i, const Eigen::Matrix<T, 3, 1>& d_j, T* r) const {
    r[0] = d_i.dot(d_j) * inverse_sigma_;
  }
  Jacobian JacobianI(const Eigen::Vector3d& /*d_i*/, const Eigen::Vector3d& d_j) const {
    return inverse_sigma_ * d_j.transpose();
  }
  Jacobian JacobianJ(const Eigen::Vector3d& d_i, const Eigen::Vector3d& /*d_j*/) const {
    return inverse_sigma_ * d_i.transpose();
  }
};

}  // namespace msc_vo
