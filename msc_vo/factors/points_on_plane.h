// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// N points that lie on a plane (not in the paper), N rows:
///
///   r_k = (n . X_k + d) / sigma
///
/// X_k: points in the world, metres (block 0, 3 N): a point landmark (N = 1), or both end points of
/// a line landmark (N = 2). (n, d): plane n . X + d = 0 in the world, n a unit vector, d in metres
/// (block 1, 4, with PlaneManifold). sigma: metres, of the distance of a point from the plane:
/// flatness of the surface, and what protrudes from it, such as frames and pictures. r is the
/// signed distance, bilinear in the blocks and defined everywhere.
///
/// Count no measurement twice: the depth of a point or line and a plane that was fitted to the
/// depth image around it are the same pixels. Of an image whose PlaneObservation is in the problem,
/// leave out the DepthReprojection or LineDepthReprojection of landmarks on that plane
/// (inverse_depth = 0 or has_depth = false in their observations); those of other images remain.
template <int N>
class PointsOnPlane : public CostFunctor<PointsOnPlane<N>, N, 3 * N, 4> {
 public:
  explicit PointsOnPlane(double sigma) : inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* points, const T* plane, T* residuals) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> normal(plane);
    for (int k = 0; k < N; ++k) {
      const Eigen::Map<const Eigen::Matrix<T, 3, 1>> x(points + 3 * k);
      residuals[k] = (normal.dot(x) + plane[3]) * inverse_sigma_;
    }
    return true;
  }

 private:
  double inverse_sigma_;  // 1/metres
};

using PointOnPlane = PointsOnPlane<1>;
using LineOnPlane = PointsOnPlane<2>;

}  // namespace msc_vo
