// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/line_direction.h"

namespace msc_vo {

/// Base of the factors on the angle between two lines: rows over the unit directions
/// d = (E - S) / |E - S| of lines i and j. S, E: end points in the world, metres (blocks 0 and 1, 6
/// each). sigma: radians, of the angle. The derived factor defines
///
/// \code
///   template <typename T> void Residual(const Eigen::Matrix<T, 3, 1>& d_i,
///                                       const Eigen::Matrix<T, 3, 1>& d_j, T* r) const;
///   Jacobian JacobianI(d_i, d_j) const;  // dr/dd_i
///   Jacobian JacobianJ(d_i, d_j) const;  // dr/dd_j
/// \endcode
template <typename Factor, int Rows>
class LinePairFactor : public WindowFactor<Factor, Rows, BlockKind::kLine, BlockKind::kLine> {
 public:
  using Jacobian = Eigen::Matrix<double, Rows, 3>;

  explicit LinePairFactor(double sigma) : inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* line_i, const T* line_j, T* residuals) const {
    Eigen::Matrix<T, 3, 1> d_i, d_j;
    if (!LineDirection(line_i, &d_i) || !LineDirection(line_j, &d_j)) return false;
    static_cast<const Factor*>(this)->Residual(d_i, d_j, residuals);
    return true;
  }

 protected:
  double inverse_sigma_;  ///< 1/radians
};

}  // namespace msc_vo
