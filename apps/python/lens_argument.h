// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

/// A Lens, the coefficients k1 k2 p1 p2 [k3], or None. Throws std::invalid_argument that names the
/// argument.
LensDistortion LensArgument(const pybind11::object& value, const std::string& name);

}  // namespace msc_vo
