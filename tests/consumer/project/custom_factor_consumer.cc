// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Adds a factor of its own to a window: the relative pose of two keyframes with an unknown scale,
// differentiated by Ceres. Two keyframes a metre apart are fixed, the measured steps are too short:
// the scale and the keyframe in between must follow.

#include <cmath>
#include <cstdio>

#include <ceres/autodiff_cost_function.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/factors/rigid3_manifold.h"

using msc_vo::BlockId;

const Eigen::Vector3d kMeasured(-0.4, 0.0, 0.0);  // metres, translation of a step

struct Step {
  template <typename T>
  bool operator()(const T* a, const T* b, const T* scale, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q_a(a), q_b(b);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t_a(a + 4), t_b(b + 4);
    const Eigen::Quaternion<T> q = q_b * q_a.conjugate();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual) << T(200.0) * q.vec(),
        T(100.0) * (t_b - q * t_a - scale[0] * kMeasured.cast<T>());
    return true;
  }
};

int main() {
  msc_vo::WindowData window;
  const auto at = [](double x) {
    return msc_vo::Rigid3(Eigen::Quaterniond::Identity(), {-x, 0, 0});
  };
  window.keyframes = {{0, at(0.0), true}, {1, at(0.2)}, {2, at(1.0), true}};

  window.extra_blocks = {{0, Eigen::VectorXd::Ones(1), nullptr}};
  const auto cost = std::make_shared<ceres::AutoDiffCostFunction<Step, 6, 7, 7, 1>>(new Step);
  window.custom_factors = {
      {"first step", cost, nullptr, {BlockId::Pose(0), BlockId::Pose(1), BlockId::Extra(0)}},
      {"second step", cost, nullptr, {BlockId::Pose(1), BlockId::Pose(2), BlockId::Extra(0)}}};

  const msc_vo::Rigid3Manifold pose;
  const msc_vo::JacobianCheck jacobians = msc_vo::CheckJacobians(
      *cost, {{0.5, 0.5, 0.1, 0.7, 0.3, 0.1, 0.2}, {0.0, 0.0, 0.6, 0.8, 0.1, 0.5, 0.0}, {1.1}},
      {&pose, &pose, nullptr});
  if (jacobians.deviation > 1e-7) {
    std::printf("%s\n", jacobians.report.c_str());
    return 1;
  }

  const msc_vo::BundleAdjustmentSummary summary =
      msc_vo::LocalBundleAdjustment(msc_vo::BundleAdjustmentOptions(), &window);
  const double scale = window.extra_blocks[0].value[0];
  const double x = window.keyframes[1].cam_from_world.OriginInSource().x();
  std::printf("scale %.6f, position %.6f m\n", scale, x);
  return summary.usable && std::abs(scale - 1.25) < 1e-6 && std::abs(x - 0.5) < 1e-6 ? 0 : 1;
}
