// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "apps/python/shared_object.h"
#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/pose_estimation/pose_factor.h"

namespace msc_vo {

/// A cost function in Python: the built-in ones and CostFunction.
struct PyCost {
  std::shared_ptr<const ceres::CostFunction> cost;
  SharedObject callable{};  ///< of `cost`, if it is one in Python

  /// See CollectsGarbage(). Factors that share the cost are not visible to the collector, which
  /// must not take the callable from them.
  template <typename Action>
  void ForEachSharedObject(const Action& action) {
    if (cost.use_count() == 1) action(&callable);
  }
};

/// The CustomFactor and ExtraBlock objects of an iterable. Throws std::invalid_argument on any
/// other item.
struct FactorLists {
  std::vector<CustomFactor> factors;
  std::vector<ExtraBlock> extra_blocks;
};
FactorLists FactorsArgument(pybind11::handle items, const std::string& name);
/// The PoseFactor objects of an iterable; none if it is None. Throws as FactorsArgument() does.
std::vector<PoseFactor> PoseFactorsArgument(pybind11::handle items, const std::string& name);

/// `manifold`: the name of one, see ManifoldName().
ExtraBlock MakeExtraBlock(int64_t id, const pybind11::object& value, const std::string& manifold,
                          bool fixed);
/// "euclidean" or "sphere".
const char* ManifoldName(const ExtraBlock& block);

}  // namespace msc_vo
