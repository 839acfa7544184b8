// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/line_direction.h"

namespace msc_vo {

/// Measured direction of a line associated with Manhattan axis k (paper: last equation of the
/// method, E_j^{M_j}: parallel to its axis, perpendicular to the two others), 2 rows:
///
///   r = (m_k . p / sigma, m_k . n / sigma_n),   m_k = R(q) e_k,   p = n x d
///
/// q: world_from_manhattan (block 0, 4: x y z w, unit, on Rotation3Manifold); column k of its
/// matrix is axis m_k in the world. d: unit direction in the world, of either sign. n: unit normal
/// of the interpretation plane, perpendicular to d. sigma, sigma_n: standard deviations of the
/// direction in and out of the interpretation plane, radians; the first depends on depth and is the
/// larger one.
///
/// With equal sigmas the norm of the rows is the sine of the angle, |d x m_k|^2 = (m_k . p)^2 +
/// (m_k . n)^2 = (d . m_k')^2 + (d . m_k'')^2, which covers all three conditions of the paper. One
/// rotation replaces the paper's three free vectors, so the axes stay orthogonal.
class ManhattanRotation : public WindowFactor<ManhattanRotation, 2, BlockKind::kAxes> {
 public:
  ManhattanRotation(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal, int axis,
                    double sigma, double normal_sigma)
      : across_(normal.cross(direction) / sigma), normal_(normal / normal_sigma), axis_(axis) {}
  /// Isotropic uncertainty: `sigma` in every direction, radians.
  ManhattanRotation(const Eigen::Vector3d& direction, int axis, double sigma)
      : ManhattanRotation(direction, direction.unitOrthogonal(), axis, sigma, sigma) {}

  template <typename T>
  bool operator()(const T* world_from_manhattan, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(world_from_manhattan);
    residuals[0] = (q.conjugate() * across_.cast<T>())[axis_];
    residuals[1] = (q.conjugate() * normal_.cast<T>())[axis_];
    return true;
  }

 private:
  Eigen::Vector3d across_;  // p / sigma
  Eigen::Vector3d normal_;  // n / sigma_n
  int axis_;                // k
};

}  // namespace msc_vo
