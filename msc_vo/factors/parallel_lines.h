// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/line_pair_factor.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Parallel lines (paper Eq. par_error), 3 rows:
///
///   r = d_i x d_j / sigma,   d = (E - S) / |E - S|
///
/// S, E: end points in the world, metres (blocks 0 and 1, 6 each). sigma: radians, of each of the
/// two components of the angle between the lines. |r| sigma is the sine of the angle, the paper's
/// sqrt(1 - d^2), and is smooth at parallel lines, where the paper's form has no derivative. The
/// order of end points and of lines changes the sign of r and not its norm.
///
/// The three rows have rank two at parallel lines: r has no component along the common direction. A
/// form with two rows would need a basis perpendicular to one of the lines, and no smooth field of
/// such bases exists.
class ParallelLines : public LinePairFactor<ParallelLines, 3> {
 public:
  using LinePairFactor::LinePairFactor;

  template <typename T>
  void Residual(const Eigen::Matrix<T, 3, 1>& d_i, const Eigen::Matrix<T, 3, 1>& d_j, T* r) const {
    r[0] = (d_i.y() * d_j.z() - d_i.z() * d_j.y()) * inverse_sigma_;
    r[1] = (d_i.z() * d_j.x() - d_i.x() * d_j.z()) * inverse_sigma_;
    r[2] = (d_i.x() * d_j.y() - d_i.y() * d_j.x()) * inverse_sigma_;
  }
  Jacobian JacobianI(const Eigen::Vector3d& /*d_i*/, const Eigen::Vector3d& d_j) const {
    return -inverse_sigma_ * Skew(d_j);
  }
  Jacobian JacobianJ(const Eigen::Vector3d& d_i, const Eigen::Vector3d& /*d_j*/) const {
    return inverse_sigma_ * Skew(d_i);
  }
};

}  // namespace msc_vo
