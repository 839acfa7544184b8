// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// A plane of the map as a depth image shows it (not in the paper), 3 rows:
///
///   r = L (-R n / (d - (R n) . t) - q),   L^T L = Sigma^-1
///
/// R, t: cam_from_world (block 0, 7). (n, d): plane n . X + d = 0 in the world, n a unit vector, d
/// in metres (block 1, 4, with PlaneManifold). q: the observed plane by its inverse depths, 1 / z =
/// q . b for rays b = (x / z, y / z, 1), 1/metres; Sigma: its covariance (PlaneFeature). In the
/// camera, the plane is n' . x + d' = 0 with n' = R n and d' = d - n' . t, so that its inverse
/// depths are -n' / d'.
///
/// The noise of a disparity sensor is constant in inverse depth, in which q is linear, so that the
/// residual is Gaussian for distant and slanted planes alike. The factor is undefined, and returns
/// false, for planes nearer to the camera than kMinPlaneDistance.
class PlaneObservation : public CostFunctor<PlaneObservation, 3, 7, 4> {
 public:
  static constexpr double kMinPlaneDistance = 0.01;  ///< metres

  PlaneObservation(const Eigen::Vector3d& inverse_depth, const Eigen::Matrix3d& covariance)
      : inverse_depth_(inverse_depth), sqrt_information_(covariance.inverse().llt().matrixU()) {}

  template <typename T>
  bool operator()(const T* cam_from_world, const T* plane, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(cam_from_world + 4), n(plane);
    const Eigen::Matrix<T, 3, 1> normal = q * n;
    const T distance = plane[3] - normal.dot(t);
    if (!(distance >= kMinPlaneDistance)) return false;
    const Eigen::Matrix<T, 3, 1> difference =
        -normal / distance - inverse_depth_.template cast<T>();
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residuals);
    r = sqrt_information_.template cast<T>() * difference;
    return true;
  }

 private:
  Eigen::Vector3d inverse_depth_;
  Eigen::Matrix3d sqrt_information_;
};

}  // namespace msc_vo
