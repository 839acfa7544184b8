// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/factors/direction_prior.h"

namespace msc_vo {

/// Direction of the vertical as measured in a camera, for instance by an accelerometer (not in the
/// paper), 2 rows:
///
///   r = 2 (e_1 . x, e_2 . x) / (1 + m . x) / sigma,   x = R d
///
/// R: rotation of cam_from_world (block 0, 7). d: vertical, a unit vector in the world (block 1, 3,
/// with UnitVectorManifold). m: measured direction in the camera. m and d must both point up
/// (as the reading of an accelerometer at rest) or both down. The other symbols are those of
/// DirectionPrior, of which this is one on x. The residual does not depend on position and heading.
class GravityDirection : public CostFunctor<GravityDirection, 2, 7, 3> {
 public:
  /// `direction_in_cam`: m, of any length but zero. `sigma`: radians, of each component of the
  /// angle.
  GravityDirection(const Eigen::Vector3d& direction_in_cam, double sigma)
      : prior_(direction_in_cam, sigma) {}

  template <typename T>
  bool operator()(const T* cam_from_world, const T* direction, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> d(direction);
    const Eigen::Matrix<T, 3, 1> x = q * d;
    return prior_(x.data(), residuals);
  }

 private:
  DirectionPrior prior_;
};

}  // namespace msc_vo
