// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/inverse_depth_line.h"

namespace msc_vo {

/// Parallel or perpendicular pair of lines of one frame (paper Eqs. par_error and perp_error within
/// a frame), Relation::kNumResiduals rows:
///
///   r = Relation(d(w_i), d(w_j))
///
/// Relation: ParallelLines or PerpendicularLines. d: direction of an InverseDepthLine from its
/// parameter block w (blocks 0 and 1, 4 each).
template <typename Relation>
class InverseDepthLinePair
    : public CostFunctor<InverseDepthLinePair<Relation>, Relation::kNumResiduals,
                         InverseDepthLine::kBlockSize, InverseDepthLine::kBlockSize> {
 public:
  /// `sigma`: radians, of the angle between the lines.
  InverseDepthLinePair(const InverseDepthLine& line_i, const InverseDepthLine& line_j, double sigma)
      : line_i_(line_i), line_j_(line_j), relation_(sigma) {}

  template <typename T>
  bool operator()(const T* block_i, const T* block_j, T* residuals) const {
    Eigen::Matrix<T, 3, 1> d_i, d_j;
    if (!line_i_.Direction(block_i, &d_i) || !line_j_.Direction(block_j, &d_j)) return false;
    relation_.Residual(d_i, d_j, residuals);
    return true;
  }

 private:
  InverseDepthLine line_i_, line_j_;
  Relation relation_;
};

}  // namespace msc_vo
