// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <utility>

#include <ceres/autodiff_cost_function.h>

namespace msc_vo {

// Base of every factor (curiously recurring): a functor with `Rows` residuals over parameter blocks
// of the sizes `Blocks`. The functor gives
//
//   template <typename T> bool operator()(const T* block0, ..., T* residuals) const;
//
// and its automatic derivative is the definition of the factor's Jacobian.
template <typename Factor, int Rows, int... Blocks>
struct CostFunctor {
  static constexpr int kNumResiduals = Rows;
  static constexpr std::array<int, sizeof...(Blocks)> kBlockSizes{Blocks...};

  // A cost function of the factor Factor(arguments...); the caller, or the problem, owns it.
  template <typename... Arguments>
  static ceres::CostFunction* Create(Arguments&&... arguments) {
    return new ceres::AutoDiffCostFunction<Factor, Rows, Blocks...>(
        new Factor(std::forward<Arguments>(arguments)...));
  }
};

}  // namespace msc_vo
