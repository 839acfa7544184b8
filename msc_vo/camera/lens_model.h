// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

/// Models of lens distortion, with the equations and the coefficients of OpenCV.
enum class LensModel {
  kRadialTangential,  ///< Brown-Conrady: k1 k2 p1 p2 k3
  kRational,          ///< Brown-Conrady over a second polynomial: k1 k2 p1 p2 k3 k4 k5 k6
  kFisheye,           ///< equidistant, Kannala-Brandt: k1 k2 k3 k4
};

/// "radial-tangential", "rational" or "fisheye".
const char* LensModelName(LensModel model);

/// Returns the model of this name; std::nullopt for any other name.
std::optional<LensModel> LensModelFromName(const std::string& name);

/// "radial-tangential, rational, fisheye", for messages.
std::string LensModelNames();

/// Names of the coefficients in OpenCV's order: {"k1", "k2", "p1", "p2", "k3"}.
const std::vector<std::string>& LensCoefficientNames(LensModel model);

/// "k1 k2 p1 p2 k3", for messages.
std::string LensCoefficientList(LensModel model);

}  // namespace msc_vo
