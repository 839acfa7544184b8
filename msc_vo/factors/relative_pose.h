// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/pose_prior.h"

namespace msc_vo {

/// A measured pose of camera b relative to camera a, the base of RelativePose and
/// ScaledRelativePose.
class RelativePoseMeasurement {
 public:
  using Matrix6d = PosePrior::Matrix6d;

  /// `b_from_a`: measurement. `covariance`: of its rotation vector in camera b (radians) and its
  /// translation (metres); symmetric, positive definite.
  RelativePoseMeasurement(const Rigid3& b_from_a, const Matrix6d& covariance)
      : translation_(b_from_a.translation()), prior_(b_from_a, covariance) {}

 protected:
  /// The rows if the true translation is `scale` times the measured one.
  template <typename T>
  bool Residual(const T* a_from_world, const T* b_from_world, const T& scale, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q_a(a_from_world), q_b(b_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t_a(a_from_world + 4), t_b(b_from_world + 4);
    T b_from_a[7];
    Eigen::Map<Eigen::Quaternion<T>> q(b_from_a);
    q = q_b * q_a.conjugate();
    const Eigen::Matrix<T, 3, 1> t = t_b - q * t_a;
    // The mean of the prior contains the unscaled translation.
    for (int i = 0; i < 3; ++i) b_from_a[4 + i] = t[i] - (scale - 1.0) * translation_[i];
    return prior_(b_from_a, residuals);
  }

 private:
  Eigen::Vector3d translation_;
  PosePrior prior_;
};

/// Relative pose of two cameras, for instance from wheel odometry (not in the paper), 6 rows:
///
///   r = L^-1 (Log(q q_0^-1), t - t_0),   (q, t) = T_b T_a^-1,   L L^T = covariance
///
/// T_a, T_b: cam_from_world (blocks 0 and 1, 7). (q_0, t_0): measured pose b_from_a. Rotation
/// vector in camera b, radians; translation in metres.
class RelativePose : public RelativePoseMeasurement,
                     public WindowFactor<RelativePose, 6, BlockKind::kPose, BlockKind::kPose> {
 public:
  using RelativePoseMeasurement::RelativePoseMeasurement;

  template <typename T>
  bool operator()(const T* a_from_world, const T* b_from_world, T* residuals) const {
    return Residual(a_from_world, b_from_world, T(1.0), residuals);
  }
};

/// Relative pose whose translation is measured up to an unknown factor, such as that of a wheel
/// with an inexact radius (not in the paper), 6 rows:
///
///   r = L^-1 (Log(q q_0^-1), t - s t_0),   (q, t) = T_b T_a^-1,   L L^T = covariance
///
/// s: scale of the measurement (block 2, 1), dimensionless, common to all measurements of a sensor.
/// The other symbols are those of RelativePose.
class ScaledRelativePose : public RelativePoseMeasurement,
                           public CostFunctor<ScaledRelativePose, 6, 7, 7, 1> {
 public:
  using RelativePoseMeasurement::RelativePoseMeasurement;

  template <typename T>
  bool operator()(const T* a_from_world, const T* b_from_world, const T* scale,
                  T* residuals) const {
    return Residual(a_from_world, b_from_world, scale[0], residuals);
  }
};

}  // namespace msc_vo
