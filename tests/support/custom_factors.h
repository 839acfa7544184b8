// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <ceres/autodiff_cost_function.h>

#include "msc_vo/bundle_adjustment/custom_factor.h"

namespace msc_vo {

// A custom factor with automatic derivatives.
template <int Rows, int... Sizes, typename Functor>
CustomFactor MakeCustomFactor(const std::string& name, const Functor& functor,
                              std::vector<BlockId> blocks) {
  CustomFactor factor;
  factor.name = name;
  factor.cost =
      std::make_shared<ceres::AutoDiffCostFunction<Functor, Rows, Sizes...>>(new Functor(functor));
  factor.blocks = std::move(blocks);
  return factor;
}

// Translation from camera a to camera b, in camera b and in units of `scale`:
// r = (t_b - R_b R_a^T t_a - scale * measured) / sigma.
struct ScaledTranslation {
  Eigen::Vector3d measured;
  double sigma;

  template <typename T>
  bool operator()(const T* a, const T* b, const T* scale, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> q_a(a), q_b(b);
    const Eigen::Map<const Vector> t_a(a + 4), t_b(b + 4);
    Eigen::Map<Vector> r(residual);
    r = (t_b - q_b * (q_a.conjugate() * t_a) - scale[0] * measured.cast<T>()) / T(sigma);
    return true;
  }
};

// Difference of two points: r = (b - a - measured) / sigma.
struct PointDifference {
  Eigen::Vector3d measured;
  double sigma;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (b[i] - a[i] - measured[i]) / sigma;
    return true;
  }
};

}  // namespace msc_vo
