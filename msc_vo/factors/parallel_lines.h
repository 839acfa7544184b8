// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/line_pair_factor.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

// Two lines that should be parallel (paper Eq. par_error), 3 rows:
//
//   r = d_i x d_j / sigma,   d = (E - S) / |E - S|
//
// S, E: end points in the world, metres (blocks 0 and 1, 6 each). sigma: radians, of the angle
// between the two per direction that it can take. |r| sigma is the sine of the angle, the paper's
// sqrt(1 - d^2), but smooth where that has no derivative: at parallel. Indifferent to the order of
// end points and of lines (the sign of r changes, its norm does not).
// Three rows of rank two: at parallel, r has no part along the common direction. A form of two rows
// needs a basis across one of the lines, which would have to turn with it (no smooth field of such
// bases exists) or be frozen outside of the equation; the third row costs six products.
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
