// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/factors/inverse_depth_line.h"
#include "msc_vo/factors/inverse_depth_line_prior.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"

namespace msc_vo {

/// The block of a line: w_S, w_E (1/metres), a, c; see InverseDepthLine.
using InverseDepthLineBlock = Eigen::Matrix<double, InverseDepthLine::kBlockSize, 1>;

/// J^T J, J^T r and half the sum of robustified squares, in blocks of four per line.
struct StructureEquations {
  using Matrix = Eigen::Matrix<double, InverseDepthLine::kBlockSize, InverseDepthLine::kBlockSize>;
  /// Contribution of one pair to J^T J.
  struct Pair {
    int i = 0, j = 0;
    Matrix ii, ij, jj;
  };
  double cost = 0.0;
  std::vector<InverseDepthLineBlock> gradient;
  std::vector<Matrix> diagonal;  ///< priors and pairs
  std::vector<Pair> pairs;
};

/// The factors of the frame-structure problem:
///
///   sum |InverseDepthLinePrior|^2 + rho(|InverseDepthLinePair<ParallelLines>|^2)
///     + rho(|InverseDepthLinePair<PerpendicularLines>|^2)
///
/// (paper: 3D Feature Position Estimation). To solve 150 lines and a thousand pairs in a few
/// milliseconds per frame, the direction of each line is differentiated once rather than for every
/// pair, and the normal equations are solved by conjugate gradients, because their Cholesky factor
/// is dense. The tests compare the result with the same factors in Ceres.
struct FrameStructureFactors {
  template <typename Relation>
  struct Pair {
    Relation relation;
    int i = 0, j = 0;  ///< indices in lines
  };
  double huber = 0.0;                         ///< sigmas, of pairs
  std::vector<InverseDepthLine> lines;        ///< those that have a partner
  std::vector<InverseDepthLinePrior> priors;  ///< one per line
  std::vector<Pair<ParallelLines>> parallel;
  std::vector<Pair<PerpendicularLines>> perpendicular;

  /// Returns false if a line has no direction.
  bool Linearize(const std::vector<InverseDepthLineBlock>& blocks,
                 StructureEquations* equations) const;
};

/// Minimises the cost by Levenberg-Marquardt from *blocks. Returns false, and leaves *blocks
/// unchanged, if a factor is undefined there or a step is not finite. *equations: normal equations
/// at the solution.
bool MinimizeStructure(const FrameStructureFactors& factors, int max_iterations,
                       std::vector<InverseDepthLineBlock>* blocks, StructureEquations* equations);

/// Upper bound of the covariance of every block, from its own prior, its pairs and the priors of
/// its partners. Further pairs could only reduce it. This requires a few small inverses instead of
/// the inverse of the whole system.
std::vector<StructureEquations::Matrix> BoundCovariances(const FrameStructureFactors& factors,
                                                         const StructureEquations& equations);

}  // namespace msc_vo
