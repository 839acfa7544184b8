// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Points of an observed landmark in camera coordinates, x_k = R X_k + t, and the chain rule from
/// x_k to the pose and to the ends X_i of the landmark (one of a point, two of a line):
///
///   dx/dw = -[R X]x,  dx/du = I       with x = Exp(w) R X + t + u, as on Rigid3Manifold
///   dx_k/dX_i = weight(k, i) R
///   dx/dq_v = 2 (-q_w [X]x + (q_v . X) I + q_v X^T - 2 X q_v^T),  dx/dq_w = 2 q_v x X
///
/// The last line, from R(q) X = X + 2 q_w (q_v x X) + 2 q_v x (q_v x X), is that of automatic
/// differentiation. The linearisation of a factor at these points (LinearizeInCamera) is shared by
/// local bundle adjustment, pose optimization and AnalyticCostFunction.
template <int Points>
struct CameraPoints {
  std::array<Eigen::Vector3d, Points> rotated;  ///< R X_k, metres
  std::array<Eigen::Vector3d, Points> x;        ///< R X_k + t, metres

  /// Computes the points. `observation`: has PointInWorld(k, landmark), as a CameraFactor. Returns
  /// false if a point is nearer than kMinCameraDepth.
  template <typename Observation>
  bool Set(const Observation& observation, const Eigen::Matrix3d& rotation,
           const Eigen::Vector3d& translation, const double* landmark) {
    for (int k = 0; k < Points; ++k) {
      rotated[k] = rotation * observation.PointInWorld(k, landmark);
      x[k] = rotated[k] + translation;
      if (!(x[k].z() >= kMinCameraDepth)) return false;
    }
    return true;
  }
};

/// d(R(q) X)/dq; columns x, y, z, w.
inline Eigen::Matrix<double, 3, 4> RotatedPointJacobian(const Eigen::Quaterniond& q,
                                                        const Eigen::Vector3d& x) {
  const Eigen::Vector3d v = q.vec();
  Eigen::Matrix<double, 3, 4> j;
  j.leftCols<3>() = 2.0 * (v * x.transpose() - 2.0 * x * v.transpose() - q.w() * Skew(x));
  j.diagonal().array() += 2.0 * v.dot(x);
  j.col(3) = 2.0 * v.cross(x);
  return j;
}

/// Rows of a camera factor and their derivatives by camera coordinates.
template <typename Factor>
struct CameraLinearization {
  Eigen::Matrix<double, Factor::kNumResiduals, 1> residual;
  /// Derivative of the rows of point k by x_k.
  std::array<Eigen::Matrix<double, Factor::kRowsPerPoint, 3>, Factor::kNumPoints> by_x;

  auto RowsOf(int k) const {
    return residual.template segment<Factor::kRowsPerPoint>(k * Factor::kRowsPerPoint);
  }
};

/// Evaluates the rows at the camera coordinates of the points.
template <typename Factor>
Eigen::Matrix<double, Factor::kNumResiduals, 1> ResidualInCamera(
    const Factor& factor, const std::array<Eigen::Vector3d, Factor::kNumPoints>& x) {
  Eigen::Matrix<double, Factor::kNumResiduals, 1> residual;
  for (int k = 0; k < Factor::kNumPoints; ++k) {
    factor.Residual(k, x[k], residual.data() + k * Factor::kRowsPerPoint);
  }
  return residual;
}

/// Evaluates the rows and their derivatives, with the same rounding.
template <typename Factor>
CameraLinearization<Factor> LinearizeInCamera(const Factor& factor,
                                              const CameraPoints<Factor::kNumPoints>& points) {
  CameraLinearization<Factor> at;
  at.residual = ResidualInCamera(factor, points.x);
  for (int k = 0; k < Factor::kNumPoints; ++k) at.by_x[k] = factor.Jacobian(k, points.x[k]);
  return at;
}

}  // namespace msc_vo
