// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/camera_factor.h"

namespace msc_vo {

/// Point reprojection (paper Eq. errorreprpoint), 2 rows:
///
///   r = (pi(T X) - p) / sigma
///
/// T: cam_from_world (block 0, 7). X: map point in the world, metres (block 1, 3). p: observed
/// pixel, undistorted. sigma: standard deviation of each coordinate of p, pixels; it grows with the
/// pyramid level, as the paper's covariance does.
class PointReprojection : public CameraFactor<PointReprojection, BlockKind::kPoint, 2> {
 public:
  PointReprojection(const PinholeCamera& camera, const Eigen::Vector2d& pixel, double sigma)
      : camera_(camera), pixel_(pixel), inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  void Residual(int /*k*/, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const {
    const Eigen::Matrix<T, 2, 1> projection = Project(camera_, x_in_cam);
    r[0] = (projection.x() - pixel_.x()) * inverse_sigma_;
    r[1] = (projection.y() - pixel_.y()) * inverse_sigma_;
  }
  Eigen::Matrix<double, 2, 3> Jacobian(int /*k*/, const Eigen::Vector3d& x_in_cam) const {
    return inverse_sigma_ * ProjectionJacobian(camera_, x_in_cam);
  }

 private:
  PinholeCamera camera_;
  Eigen::Vector2d pixel_;
  double inverse_sigma_;  // 1/pixels
};

}  // namespace msc_vo
