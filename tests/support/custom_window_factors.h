// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include <ceres/autodiff_cost_function.h>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Wheel odometry: the measured motion from camera a to camera b, whose translation a scale (block
// 2, 1) converts to metres; 6 rows. Sigmas in radians and metres.
struct WheelStepResidual {
  Rigid3 b_from_a;
  double rotation_sigma, translation_sigma;

  template <typename T>
  bool operator()(const T* a, const T* b, const T* scale, T* r) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q_a(a), q_b(b);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t_a(a + 4), t_b(b + 4);
    const Eigen::Quaternion<T> q = q_b * q_a.conjugate();
    const Eigen::Quaternion<T> turn = q * b_from_a.rotation().conjugate().template cast<T>();
    const Eigen::Matrix<T, 3, 1> step = t_b - q * t_a;
    for (int i = 0; i < 3; ++i) {
      r[i] = 2.0 * turn.w() * turn.vec()[i] / rotation_sigma;
      r[3 + i] = (scale[0] * b_from_a.translation()[i] - step[i]) / translation_sigma;
    }
    return true;
  }
};

inline CustomFactor WheelStep(int64_t a, int64_t b, const Rigid3& b_from_a, double rotation_sigma,
                              double translation_sigma) {
  using Cost = ceres::AutoDiffCostFunction<WheelStepResidual, 6, 7, 7, 1>;
  return {
      "wheel step to keyframe " + std::to_string(b),
      std::make_shared<Cost>(new WheelStepResidual{b_from_a, rotation_sigma, translation_sigma}),
      nullptr,
      {BlockId::Pose(a), BlockId::Pose(b), BlockId::Extra(0)}};
}

// An extra block of one number.
inline ExtraBlock Scalar(int64_t id, double value) {
  ExtraBlock block;
  block.id = id;
  block.value = Eigen::VectorXd::Constant(1, value);
  return block;
}

}  // namespace msc_vo
