// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <memory>
#include <utility>

#include <ceres/autodiff_cost_function.h>

#include "msc_vo/factors/block_kind.h"

namespace msc_vo {

/// Base of every factor (CRTP): a functor with `Rows` residuals over parameter blocks of the sizes
/// `Blocks`. The derived factor defines
///
/// \code
///   template <typename T> bool operator()(const T* block0, ..., T* residuals) const;
/// \endcode
///
/// Its automatic derivative is the reference that analytic Jacobians are tested against.
template <typename Factor, int Rows, int... Blocks>
struct CostFunctor {
  static constexpr int kNumResiduals = Rows;
  static constexpr std::array<int, sizeof...(Blocks)> kBlockSizes{Blocks...};

  /// Returns an automatically differentiated cost function of Factor(arguments...). The caller owns
  /// it; ceres::Problem::AddResidualBlock takes ownership.
  template <typename... Arguments>
  static ceres::CostFunction* Create(Arguments&&... arguments) {
    return new ceres::AutoDiffCostFunction<Factor, Rows, Blocks...>(
        new Factor(std::forward<Arguments>(arguments)...));
  }
  /// The same with shared ownership, for CustomFactor and PoseFactor.
  template <typename... Arguments>
  static std::shared_ptr<const ceres::CostFunction> CreateShared(Arguments&&... arguments) {
    return std::shared_ptr<const ceres::CostFunction>(
        Create(std::forward<Arguments>(arguments)...));
  }
};

/// Base of the factors that the library itself adds to a window: a CostFunctor that names the kinds
/// of its parameter blocks, from which their sizes follow.
template <typename Factor, int Rows, BlockKind... Kinds>
struct WindowFactor : CostFunctor<Factor, Rows, BlockSize(Kinds)...> {
  static_assert(((Kinds != BlockKind::kExtra) && ...), "use CostFunctor for extra blocks");
  static constexpr std::array<BlockKind, sizeof...(Kinds)> kBlockKinds{Kinds...};
};

}  // namespace msc_vo
