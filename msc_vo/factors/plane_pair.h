// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"

namespace msc_vo {

/// Two planes whose normals have the relation of two lines, ParallelLines or PerpendicularLines
/// (not in the paper, which has them for lines only), 3 rows of rank 2, or 1 row:
///
///   r = n_i x n_j / sigma   or   r = n_i . n_j / sigma
///
/// (n, d): plane n . X + d = 0 in the world, n a unit vector, d in metres (blocks 0 and 1, 4 each,
/// with PlaneManifold). sigma: radians, of the angle between the planes (of each of its two
/// components if they are parallel). |r| sigma is the sine of the angle to the ideal one. The order
/// of the planes and the signs of normals change at most the sign of r. The distance of parallel
/// planes is free.
///
/// Count no measurement twice: use it for planes of different surfaces only. Two landmarks of one
/// surface are one landmark. Among k planes that are all partners of each other, each deviates from
/// its ideal direction in k - 1 pairs: sigma must grow with the number of partners, or all but the
/// pairs with one of the planes be left out.
template <typename Relation>
class PlanePair : public CostFunctor<PlanePair<Relation>, Relation::kNumResiduals, 4, 4> {
 public:
  explicit PlanePair(double sigma) : relation_(sigma) {}

  template <typename T>
  bool operator()(const T* plane_i, const T* plane_j, T* residuals) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    relation_.Residual(Vector3(plane_i[0], plane_i[1], plane_i[2]),
                       Vector3(plane_j[0], plane_j[1], plane_j[2]), residuals);
    return true;
  }

 private:
  Relation relation_;
};

using ParallelPlanes = PlanePair<ParallelLines>;
using PerpendicularPlanes = PlanePair<PerpendicularLines>;

}  // namespace msc_vo
