// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>

#include <ceres/sized_cost_function.h>

#include "msc_vo/factors/camera_linearization.h"

namespace msc_vo {

/// Ceres cost function of a CameraFactor with analytic derivatives, from camera_linearization.h.
/// The Jacobian equals that of automatic differentiation in all seven ambient coordinates of the
/// pose.
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
    CameraPoints<Factor::kNumPoints> points;
    if (!points.Set(factor_, rotation, t, parameters[1])) return false;
    const CameraLinearization<Factor> at = LinearizeInCamera(factor_, points);
    std::copy_n(at.residual.data(), Factor::kNumResiduals, residuals);
    for (int k = 0; k < Factor::kNumPoints; ++k) {
      if (jacobians[0] != nullptr) {
        auto pose = PoseJacobian(jacobians[0]).template middleRows<kRows>(k * kRows);
        pose.template leftCols<4>() =
            at.by_x[k] * RotatedPointJacobian(q, factor_.PointInWorld(k, parameters[1]));
        pose.template rightCols<3>() = at.by_x[k];
      }
      for (int i = 0; i < Factor::kNumPoints && jacobians[1] != nullptr; ++i) {
        LandmarkJacobian(jacobians[1]).template block<kRows, 3>(k * kRows, 3 * i) =
            factor_.Weight(k, i) * at.by_x[k] * rotation;
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

  Factor factor_;
};

}  // namespace msc_vo
