// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/camera_linearization.h"
#include "msc_vo/factors/robust_loss.h"

namespace msc_vo {

/// Normal equations of one observation: Gauss-Newton Hessian and gradient of the sum of its factors
/// with respect to the camera coordinates of its points, and their chain rule to the pose (tangent
/// space of Rigid3Manifold) and to the landmark. The chain rule is applied once per observation, to
/// 3x3 blocks, rather than once per factor to its rows.
template <int Points>
struct CameraEquations {
  template <int Rows, int Cols>
  using Matrix = Eigen::Matrix<double, Rows, Cols>;

  /// Where AddTo() adds its blocks; null: none.
  struct Blocks {
    Matrix<6, 6>* pose_hessian = nullptr;
    Matrix<6, 1>* pose_gradient = nullptr;
    Matrix<3 * Points, 3 * Points>* landmark_hessian = nullptr;
    Matrix<3 * Points, 1>* landmark_gradient = nullptr;
    Matrix<6, 3 * Points>* coupling = nullptr;
  };

  std::array<Eigen::Matrix3d, Points> hessian;
  std::array<Eigen::Vector3d, Points> gradient;
  double cost = 0.0;  ///< Half the sum of robust squared norms.

  CameraEquations() {
    hessian.fill(Eigen::Matrix3d::Zero());
    gradient.fill(Eigen::Vector3d::Zero());
  }

  template <typename Factor>
  void Add(const Factor& factor, const HuberLoss& loss, const CameraPoints<Points>& points) {
    const CameraLinearization<Factor> at = LinearizeInCamera(factor, points);
    const double s = at.residual.squaredNorm();
    const double weight = loss.Weight(s);
    cost += 0.5 * loss.Cost(s);
    for (int k = 0; k < Points; ++k) {
      const Matrix<Factor::kRowsPerPoint, 3> weighted = weight * at.by_x[k];
      hessian[k].noalias() += weighted.transpose() * at.by_x[k];
      gradient[k].noalias() += weighted.transpose() * at.RowsOf(k);
    }
  }

  /// `observation`: has Weight(k, i), as a CameraFactor. `rotation`: of cam_from_world.
  template <typename Observation>
  void AddTo(const Blocks& blocks, const Observation& observation, const Eigen::Matrix3d& rotation,
             const CameraPoints<Points>& points) const {
    for (int k = 0; k < Points; ++k) {
      const Eigen::Matrix3d h_rotation = hessian[k] * rotation;
      if (blocks.landmark_hessian != nullptr) {
        AddToLandmark(blocks, observation, k, rotation.transpose() * h_rotation,
                      rotation.transpose() * gradient[k]);
      }
      if (blocks.pose_hessian == nullptr) continue;
      const Eigen::Matrix3d arm = Skew(points.rotated[k]);
      AddToPose(blocks, k, arm, points.rotated[k]);
      if (blocks.coupling == nullptr) continue;
      for (int i = 0; i < Points; ++i) {
        const double weight = observation.Weight(k, i);
        if (weight == 0.0) continue;
        auto coupling = blocks.coupling->template middleCols<3>(3 * i);
        coupling.template topRows<3>().noalias() += weight * arm * h_rotation;
        coupling.template bottomRows<3>() += weight * h_rotation;
      }
    }
  }

 private:
  // From point k of a landmark to the ends of which it is a weighted mean.
  template <typename Observation>
  static void AddToLandmark(const Blocks& blocks, const Observation& observation, int k,
                            const Eigen::Matrix3d& h, const Eigen::Vector3d& g) {
    for (int i = 0; i < Points; ++i) {
      const double weight = observation.Weight(k, i);
      if (weight == 0.0) continue;
      blocks.landmark_gradient->template segment<3>(3 * i) += weight * g;
      for (int j = 0; j < Points; ++j) {
        if (observation.Weight(k, j) == 0.0) continue;
        blocks.landmark_hessian->template block<3, 3>(3 * i, 3 * j) +=
            (weight * observation.Weight(k, j)) * h;
      }
    }
  }

  // dx = [-[R X]x, I] (w, u), with arm = [R X]x.
  void AddToPose(const Blocks& blocks, int k, const Eigen::Matrix3d& arm,
                 const Eigen::Vector3d& rotated) const {
    const Eigen::Matrix3d arm_h = arm * hessian[k];
    Matrix<6, 6>& h = *blocks.pose_hessian;
    h.template topLeftCorner<3, 3>().noalias() -= arm_h * arm;
    h.template bottomLeftCorner<3, 3>() += arm_h.transpose();
    h.template bottomRightCorner<3, 3>() += hessian[k];
    blocks.pose_gradient->template head<3>() += rotated.cross(gradient[k]);
    blocks.pose_gradient->template tail<3>() += gradient[k];
  }
};

}  // namespace msc_vo
