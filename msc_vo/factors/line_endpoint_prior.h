// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Prior on the end points of a line along its direction (not in the paper), 2 rows:
///
///   r = ((S - S0) . d0 / sigma, (E - E0) . d0 / sigma)
///
/// S, E: end points in the world, metres (block 0, 6). S0, E0: their initial values; d0: initial
/// unit direction. sigma: metres.
///
/// Line observations do not constrain the position of an end point along its line, so two of the
/// six coordinates are free without this prior. It conditions the normal equations and leaves the
/// line's four degrees of freedom unconstrained.
class LineEndpointPrior : public WindowFactor<LineEndpointPrior, 2, BlockKind::kLine> {
 public:
  LineEndpointPrior(const LineSegment3& initial, double sigma)
      : initial_(initial), direction_(initial.Direction()), inverse_sigma_(1.0 / sigma) {}

  template <typename T>
  bool operator()(const T* line, T* residuals) const {
    residuals[0] = T(0.0);
    residuals[1] = T(0.0);
    for (int i = 0; i < 3; ++i) {
      residuals[0] += (line[i] - initial_.start[i]) * (direction_[i] * inverse_sigma_);
      residuals[1] += (line[i + 3] - initial_.end[i]) * (direction_[i] * inverse_sigma_);
    }
    return true;
  }
  /// Derivative of row 0 with respect to S, equal to that of row 1 with respect to E, 1/metres.
  Eigen::Vector3d Jacobian() const { return inverse_sigma_ * direction_; }

 private:
  LineSegment3 initial_;
  Eigen::Vector3d direction_;
  double inverse_sigma_;  // 1/metres
};

}  // namespace msc_vo
