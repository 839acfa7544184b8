// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ceres/sized_cost_function.h>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

/// Ceres cost function of a CameraFactor with analytic derivatives.
///
/// Chain rule over the camera coordinates x = R(q) X + t: the factor gives dr/dx, and
///
///   dx/dt = I,  dx/dX = R(q),  dx/dq_v = 2 (-q_w [X]x + (q_v . X) I + q_v X^T - 2 X q_v^T),
///   dx/dq_w = 2 q_v x X,
///
/// from R(q) X = X + 2 q_w (q_v x X) + 2 q_v x (q_v x X). The Jacobian equals that of automatic
/// differentiation in all seven ambient coordinates of the pose.
template <typename Factor>
class AnalyticCostFunction final
    : public ceres::SizedCostFunction<Factor::kNumResiduals, 7, 3 * Factor::kNumPoints> {
 public:
  explicit AnalyticCostFunction(const Factor& factor) : factor_(factor) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (jacobians == nullptr) return factor_(parameters[0], parameters[1], residuals);
    const Eigen::Map<const Eigen::Quaterniond> q(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> t(parameters[0] + 4);
    const Eigen::Matrix3d rotation = q.toRotationMatrix();
    for (int k = 0; k < Factor::kNumPoints; ++k) {
      const Eigen::Vector3d x_in_world = factor_.PointInWorld(k, parameters[1]);
      const Eigen::Vector3d x_in_cam = rotation * x_in_world + t;
      if (!(x_in_cam.z() >= kMinCameraDepth)) return false;
      Eigen::Matrix<double, kRows, 3> j;
      LinearizeInCamera(factor_, k, x_in_cam, residuals + k * kRows, &j);
      if (jacobians[0] != nullptr) {
        auto pose = PoseJacobian(jacobians[0]).template middleRows<kRows>(k * kRows);
        pose.template leftCols<4>() = j * RotatedPointJacobian(q, x_in_world);
        pose.template rightCols<3>() = j;
      }
      for (int i = 0; i < Factor::kNumPoints && jacobians[1] != nullptr; ++i) {
        LandmarkJacobian(jacobians[1]).template block<kRows, 3>(k * kRows, 3 * i) =
            factor_.Weight(k, i) * j * rotation;
      }
    }
    return true;
  }

 private:
  static constexpr int kRows = Factor::kRowsPerPoint;
  template <int Cols>
  using Jacobian = Eigen::Map<Eigen::Matrix<double, Factor::kNumResiduals, Cols, Eigen::RowMajor>>;

  static Jacobian<7> PoseJacobian(double* data) { return Jacobian<7>(data); }
  static Jacobian<3 * Factor::kNumPoints> LandmarkJacobian(double* data) {
    return Jacobian<3 * Factor::kNumPoints>(data);
  }

  // d(R(q) X)/dq; columns x, y, z, w.
  static Eigen::Matrix<double, 3, 4> RotatedPointJacobian(const Eigen::Quaterniond& q,
                                                          const Eigen::Vector3d& x) {
    const Eigen::Vector3d v = q.vec();
    Eigen::Matrix<double, 3, 4> j;
    j.leftCols<3>() = 2.0 * (v * x.transpose() - 2.0 * x * v.transpose() - q.w() * Skew(x));
    j.diagonal().array() += 2.0 * v.dot(x);
    j.col(3) = 2.0 * v.cross(x);
    return j;
  }

  Factor factor_;
};

}  // namespace msc_vo
