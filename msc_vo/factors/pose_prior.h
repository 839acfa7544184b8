// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Cholesky>
#include <ceres/rotation.h>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Prior on a pose (not in the paper), 6 rows:
///
///   r = L^-1 (w, u),   w = Log(q q_0^-1),  u = t - t_0,  L L^T = covariance
///
/// (q, t): cam_from_world (block 0, 7). (q_0, t_0): mean of the prior. (w, u): difference to the
/// mean in the tangent space of Rigid3Manifold, rotation vector in the camera frame (radians), then
/// translation (metres). The residual is smooth for rotations below 180 degrees.
class PosePrior : public WindowFactor<PosePrior, 6, BlockKind::kPose> {
 public:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  /// `covariance`: of (w, u); symmetric, positive definite.
  PosePrior(const Rigid3& cam_from_world, const Matrix6d& covariance)
      : mean_(cam_from_world), whitening_(covariance.llt().matrixL().solve(Matrix6d::Identity())) {}

  template <typename T>
  bool operator()(const T* cam_from_world, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Quaternion<T> turn = q * mean_.rotation().conjugate().template cast<T>();
    const T turn_wxyz[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    T distance[6];
    ceres::QuaternionToAngleAxis(turn_wxyz, distance);
    for (int i = 0; i < 3; ++i) distance[3 + i] = cam_from_world[4 + i] - mean_.translation()[i];
    for (int row = 0; row < 6; ++row) {
      residuals[row] = T(0.0);
      for (int i = 0; i <= row; ++i) residuals[row] += whitening_(row, i) * distance[i];
    }
    return true;
  }

  /// Derivative of r in the tangent space of Rigid3Manifold at `cam_from_world`, from
  /// Log(Exp(d) Exp(w)) = w + J_l^-1(w) d + O(d^2).
  Matrix6d TangentJacobian(const Rigid3& cam_from_world) const {
    const Eigen::Vector3d w = LogSO3(cam_from_world.rotation() * mean_.rotation().conjugate());
    Matrix6d distance = Matrix6d::Identity();
    distance.topLeftCorner<3, 3>() = InverseLeftJacobianSO3(w);
    return whitening_ * distance;
  }

 private:
  Rigid3 mean_;
  Matrix6d whitening_;  // L^-1, lower triangular
};

}  // namespace msc_vo
