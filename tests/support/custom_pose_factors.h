// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>

#include "msc_vo/factors/pose_prior.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/pose_estimation/pose_factor.h"

namespace msc_vo {

// Difference between the measured direction of gravity in the camera and that of the world, 3 rows.
struct GravityResidual {
  Eigen::Vector3d in_cam, in_world;  // unit vectors
  double sigma;                      // radians

  template <typename T>
  bool operator()(const T* cam_from_world, T* r) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    Eigen::Map<Eigen::Matrix<T, 3, 1>> difference(r);
    difference = (q * in_world.cast<T>() - in_cam.cast<T>()) / T(sigma);
    return true;
  }
};

inline PoseFactor GravityFactor(const Eigen::Vector3d& in_cam, double sigma) {
  using Cost = ceres::AutoDiffCostFunction<GravityResidual, 3, 7>;
  return {"gravity",
          std::make_shared<Cost>(new GravityResidual{in_cam, Eigen::Vector3d::UnitY(), sigma}),
          nullptr};
}

inline Eigen::Matrix<double, 6, 6> DiagonalPoseCovariance(double rotation_sigma,
                                                          double translation_sigma) {
  Eigen::Matrix<double, 6, 1> variance;
  variance << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(translation_sigma * translation_sigma);
  return variance.asDiagonal();
}

// A measured pose, such as the last one moved by a wheel step. Sigmas in radians and metres.
inline PoseFactor PriorFactor(const std::string& name, const Rigid3& cam_from_world,
                              double rotation_sigma, double translation_sigma) {
  return {name,
          PosePrior::CreateShared(cam_from_world,
                                  DiagonalPoseCovariance(rotation_sigma, translation_sigma)),
          nullptr};
}

}  // namespace msc_vo
