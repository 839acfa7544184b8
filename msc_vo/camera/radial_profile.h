// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

namespace msc_vo {

/// The radial factor of a rational lens. `k`: its coefficients; `r2`: squared distance from the
/// optical axis on the plane z = 1. T: double or ceres::Jet.
template <typename T>
T RationalScale(const T* k, const T& r2) {
  return (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
         (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
}

/// The factor theta_d / r of a fisheye lens; arguments as for RationalScale().
template <typename T>
T FisheyeScale(const T* k, const T& r2) {
  using std::atan;
  using std::sqrt;
  // Below, the series 1 + (k1 - 1/3) r^2 is exact to the last digit, and the root has a derivative.
  constexpr double kSeries = 1e-10;
  if (r2 < kSeries) return 1.0 + r2 * (k[0] - 1.0 / 3.0);
  const T r = sqrt(r2);
  const T theta = atan(r);
  const T t2 = theta * theta;
  return theta / r * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}

}  // namespace msc_vo
