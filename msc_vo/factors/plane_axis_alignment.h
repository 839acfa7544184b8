// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/manhattan_axis_alignment.h"

namespace msc_vo {

/// A plane whose normal is parallel to a Manhattan axis (not in the paper, whose
/// ManhattanAxisAlignment it applies to a normal), 2 rows:
///
///   r = (e_1 . n, e_2 . n) / sigma
///
/// (n, d): plane n . X + d = 0 in the world, n a unit vector, d in metres (block 0, 4, with
/// PlaneManifold). e_1, e_2: unit vectors that complete the axis to an orthonormal basis. sigma:
/// radians, of each component of the angle between normal and axis. |r| sigma is the sine of that
/// angle and does not depend on the sign of n. The offset d is free.
///
/// Count no measurement twice: planes that are aligned with axes need no PlanePair with each other,
/// and the axes must not have been estimated from the planes of the same problem. The error of the
/// axis is common to all of its planes, so that many of them are weighed too much by a sigma that
/// includes it.
class PlaneAxisAlignment : public CostFunctor<PlaneAxisAlignment, 2, 4> {
 public:
  /// `axis`: a unit vector in the world.
  PlaneAxisAlignment(const Eigen::Vector3d& axis, double sigma) : alignment_(axis, sigma) {}

  template <typename T>
  bool operator()(const T* plane, T* residuals) const {
    alignment_.Residual(Eigen::Matrix<T, 3, 1>(plane[0], plane[1], plane[2]), residuals);
    return true;
  }

 private:
  ManhattanAxisAlignment alignment_;
};

}  // namespace msc_vo
