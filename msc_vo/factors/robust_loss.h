// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

namespace msc_vo {

/// Huber loss rho of a squared residual norm s, with the values of ceres::HuberLoss:
///
///   rho(s) = s                                   for s <= threshold^2
///   rho(s) = 2 threshold sqrt(s) - threshold^2   otherwise
///
/// The robust cost of a residual r is rho(|r|^2) / 2.
struct HuberLoss {
  double threshold = 0.0;  ///< In standard deviations of the residual; 0 disables the loss.

  double Cost(double s) const {
    if (IsQuadratic(s)) return s;
    return 2.0 * threshold * std::sqrt(s) - threshold * threshold;
  }
  /// rho'(s): weight of the residual's J^T J and J^T r.
  double Weight(double s) const { return IsQuadratic(s) ? 1.0 : threshold / std::sqrt(s); }

 private:
  bool IsQuadratic(double s) const { return threshold == 0.0 || s <= threshold * threshold; }
};

}  // namespace msc_vo
