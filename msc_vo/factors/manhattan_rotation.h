// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/line_direction.h"

namespace msc_vo {

// Measured direction of a line that belongs to Manhattan axis k (paper: last equation of the
// method, E_j^{M_j}: parallel to its axis, perpendicular to the two others), 2 rows:
//
//   r = (d . m_k', d . m_k'') / sigma,   m_k = R(q) e_k,   (k, k', k'') cyclic
//
// q: world_from_manhattan (block 0, 4: x y z w, unit, on Rotation3Manifold); column k of its matrix
// is axis m_k in the world. d: unit direction in the world, sign free. sigma: radians per
// direction. The two rows say all three conditions: they are the perpendicular ones, and their
// norm is that of the parallel one, |d x m_k|^2 = (d . m_k')^2 + (d . m_k'')^2, which as a row of
// its own would count the same angle twice. One rotation instead of the paper's three free vectors,
// so that axes stay orthogonal without the SVD at its end.
class ManhattanRotation : public CostFunctor<ManhattanRotation, 2, 4> {
 public:
  ManhattanRotation(const Eigen::Vector3d& direction, int axis, double sigma)
      : direction_(direction), axis_(axis), inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* world_from_manhattan, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(world_from_manhattan);
    const Eigen::Matrix<T, 3, 1> in_manhattan = q.conjugate() * direction_.cast<T>();
    residuals[0] = in_manhattan[(axis_ + 1) % 3] * inverse_sigma_;
    residuals[1] = in_manhattan[(axis_ + 2) % 3] * inverse_sigma_;
    return true;
  }

 private:
  Eigen::Vector3d direction_;
  int axis_;              // k
  double inverse_sigma_;  // 1/radians
};

}  // namespace msc_vo
