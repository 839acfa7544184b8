// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/camera_factor.h"

namespace msc_vo {

/// Inverse depth of a point, 1 row (not in the paper):
///
///   r = (1 / z(T X) - w) / sigma
///
/// T: cam_from_world (block 0, 7). X: map point in the world, metres (block 1, 3). z: third camera
/// coordinate, metres. w: measured inverse depth, 1/metres. sigma: its standard deviation,
/// 1/metres.
///
/// The noise of a disparity sensor is constant in inverse depth, so the weight of an error in
/// metres falls with z^-4 and distant points are hardly constrained.
class DepthReprojection : public CameraFactor<DepthReprojection, BlockKind::kPoint, 1> {
 public:
  DepthReprojection(double inverse_depth, double sigma)
      : inverse_depth_(inverse_depth), inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  void Residual(int /*k*/, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const {
    r[0] = (1.0 / x_in_cam.z() - inverse_depth_) * inverse_sigma_;
  }
  Eigen::RowVector3d Jacobian(int /*k*/, const Eigen::Vector3d& x_in_cam) const {
    return {0.0, 0.0, -inverse_sigma_ / (x_in_cam.z() * x_in_cam.z())};
  }

 private:
  double inverse_depth_;  // 1/metres
  double inverse_sigma_;  // metres
};

}  // namespace msc_vo
