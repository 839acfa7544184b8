// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/line_direction.h"

namespace msc_vo {

// Two lines that should be perpendicular (paper Eq. perp_error), 1 row:
//
//   r = d_i . d_j / sigma,   d = (E - S) / |E - S|
//
// S, E: end points in the world, metres (blocks 0 and 1, 6 each). sigma: radians, of the angle
// between the two. Signed, without the paper's absolute value, whose kink lies where the residual
// is zero; once squared they are the same. Indifferent to the order of end points and of lines.
class PerpendicularLines : public CostFunctor<PerpendicularLines, 1, 6, 6> {
 public:
  explicit PerpendicularLines(double sigma) : inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* line_i, const T* line_j, T* residuals) const {
    Eigen::Matrix<T, 3, 1> d_i, d_j;
    if (!LineDirection(line_i, &d_i) || !LineDirection(line_j, &d_j)) return false;
    Residual(d_i, d_j, residuals);
    return true;
  }

  // The row as a function of the unit directions.
  template <typename T>
  void Residual(const Eigen::Matrix<T, 3, 1>& d_i, const Eigen::Matrix<T, 3, 1>& d_j, T* r) const {
    r[0] = d_i.dot(d_j) * inverse_sigma_;
  }

 private:
  double inverse_sigma_;  // 1/radians
};

}  // namespace msc_vo
