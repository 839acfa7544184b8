// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/lens_argument.h"

#include <algorithm>
#include <stdexcept>

#include "apps/python/arrays.h"

namespace msc_vo {

LensDistortion LensArgument(const pybind11::object& value, const std::string& name) {
  LensDistortion lens;
  if (value.is_none()) return lens;
  if (pybind11::isinstance<LensDistortion>(value)) return value.cast<LensDistortion>();
  const Eigen::VectorXd k = VectorArgument(value, name, -1);
  if (k.size() != 0 && k.size() != 4 && k.size() != 5) {
    throw std::invalid_argument(name + ": expected k1 k2 p1 p2 [k3] or a Lens, not " +
                                std::to_string(k.size()) + " numbers");
  }
  std::copy(k.begin(), k.end(), lens.k.begin());
  return lens;
}

}  // namespace msc_vo
