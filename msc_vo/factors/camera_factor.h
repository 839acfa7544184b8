// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// Smallest depth z (metres) at which a camera factor is defined. It keeps 1/z and the image
/// coordinates bounded; for points that are nearer or behind the camera a factor returns false.
constexpr double kMinCameraDepth = 0.01;

/// pi(x): projects a point in camera coordinates (metres) to the image (pixels).
template <typename T>
Eigen::Matrix<T, 2, 1> Project(const PinholeCamera& camera,
                               const Eigen::Matrix<T, 3, 1>& x_in_cam) {
  return {camera.fx * x_in_cam.x() / x_in_cam.z() + camera.cx,
          camera.fy * x_in_cam.y() / x_in_cam.z() + camera.cy};
}

/// d pi(x) / dx, pixels per metre.
inline Eigen::Matrix<double, 2, 3> ProjectionJacobian(const PinholeCamera& camera,
                                                      const Eigen::Vector3d& x_in_cam) {
  const double inverse_z = 1.0 / x_in_cam.z();
  const double u = camera.fx * inverse_z, v = camera.fy * inverse_z;
  Eigen::Matrix<double, 2, 3> j;
  j << u, 0.0, -u * x_in_cam.x() * inverse_z, 0.0, v, -v * x_in_cam.y() * inverse_z;
  return j;
}

/// Base of the factors that depend on a landmark only through the camera coordinates x = T X of its
/// points: one for a point landmark, start and end for a line. Parameter blocks: cam_from_world
/// (7), landmark (3 per point). The derived factor defines the rows of point k and their analytic
/// derivative,
///
/// \code
///   template <typename T>
///   void Residual(int k, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const;
///   Eigen::Matrix<double, RowsPerPoint, 3> Jacobian(int k, const Vector3d& x_in_cam) const;
/// \endcode
///
/// The chain rule from x to pose and landmark is shared (AnalyticCostFunction, pose optimization
/// and local bundle adjustment).
template <typename Factor, int Points, int RowsPerPoint>
struct CameraFactor : CostFunctor<Factor, Points * RowsPerPoint, 7, 3 * Points> {
  static constexpr int kNumPoints = Points;
  static constexpr int kRowsPerPoint = RowsPerPoint;

  template <typename T>
  bool operator()(const T* cam_from_world, const T* landmark, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(cam_from_world + 4);
    for (int k = 0; k < Points; ++k) {
      const Eigen::Map<const Eigen::Matrix<T, 3, 1>> x_in_world(landmark + 3 * k);
      const Eigen::Matrix<T, 3, 1> x_in_cam = q * x_in_world + t;
      if (!(x_in_cam.z() >= kMinCameraDepth)) return false;
      static_cast<const Factor*>(this)->Residual(k, x_in_cam, residuals + k * RowsPerPoint);
    }
    return true;
  }
};

/// Evaluates the rows of point k and their derivative with respect to its camera coordinates.
template <typename Factor>
void LinearizeInCamera(const Factor& factor, int k, const Eigen::Vector3d& x_in_cam,
                       double* residual,
                       Eigen::Matrix<double, Factor::kRowsPerPoint, 3>* jacobian) {
  factor.Residual(k, x_in_cam, residual);
  *jacobian = factor.Jacobian(k, x_in_cam);
}

}  // namespace msc_vo
