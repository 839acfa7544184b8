// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/jet.h>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/geometry/pinhole_camera.h"

namespace msc_vo {

// Nearest depth z (metres) at which a camera factor is defined: 1 cm, inside any lens, so that 1/z
// and the image coordinates stay bounded. Nearer, or behind the camera, a factor returns false.
constexpr double kMinCameraDepth = 0.01;

// pi(x): the image of a point in camera coordinates, pixels.
template <typename T>
Eigen::Matrix<T, 2, 1> Project(const PinholeCamera& camera,
                               const Eigen::Matrix<T, 3, 1>& x_in_cam) {
  return {camera.fx * x_in_cam.x() / x_in_cam.z() + camera.cx,
          camera.fy * x_in_cam.y() / x_in_cam.z() + camera.cy};
}

// Base of the factors that see a landmark through the camera coordinates x = T X of its points only
// (one for a point, start and end for a line). Blocks: cam_from_world (7), landmark (3 per point).
// The factor gives the rows that belong to point k,
//
//   template <typename T> void Residual(int k, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const;
//
// With that, its derivatives need a Jet of three numbers instead of ten or thirteen; the rest is
// the same chain rule for all (ChainRuleCost, and the pose problem).
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

// Rows of point k and their derivative with respect to its camera coordinates.
template <typename Factor>
void LinearizeInCamera(const Factor& factor, int k, const Eigen::Vector3d& x_in_cam,
                       double* residual,
                       Eigen::Matrix<double, Factor::kRowsPerPoint, 3>* jacobian) {
  using Jet = ceres::Jet<double, 3>;
  const Eigen::Matrix<Jet, 3, 1> x(Jet(x_in_cam.x(), 0), Jet(x_in_cam.y(), 1),
                                   Jet(x_in_cam.z(), 2));
  Jet rows[Factor::kRowsPerPoint];
  factor.Residual(k, x, rows);
  for (int i = 0; i < Factor::kRowsPerPoint; ++i) {
    residual[i] = rows[i].a;
    jacobian->row(i) = rows[i].v.transpose();
  }
}

}  // namespace msc_vo
