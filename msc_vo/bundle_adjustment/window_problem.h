// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

struct WindowTerms;
class WindowState;

/// Sliding-window problem builder: assembles the factors of a keyframe window into a
/// ceres::Problem, the same that LocalBundleAdjustment minimises with a Ceres solver. It can be
/// solved, extended and inspected:
///
///   WindowProblem window(options, data);
///   window.AddResidualBlock(MyFactor::Create(...), nullptr, {window.Block(BlockId::Pose(7))});
///   ceres::Solver::Summary summary;
///   ceres::Solve(window.SolverOptions(10), window.problem(), &summary);
///   window.WriteBack(&data);
///
/// There is one residual block per factor, with analytic derivatives and the Huber loss of its
/// term. Observations of landmarks behind the camera are left out, as are the observations, depths,
/// pairs and alignments that `data` marks as rejected: the problem has all measurements of a window
/// that was not solved yet, and the inliers of one that was.
/// Outliers are not searched and no landmark noise is estimated; LocalBundleAdjustment does both.
class WindowProblem {
 public:
  /// Copies `data`. Throws std::invalid_argument as LocalBundleAdjustment does.
  WindowProblem(const BundleAdjustmentOptions& options, const WindowData& data);
  /// Over terms and a state of LocalBundleAdjustment, which like `data` must outlive the problem.
  /// Ceres does not check its input.
  WindowProblem(const BundleAdjustmentOptions& options, const WindowData& data,
                const WindowTerms& terms, WindowState* state);
  ~WindowProblem();
  WindowProblem(const WindowProblem&) = delete;
  WindowProblem& operator=(const WindowProblem&) = delete;

  /// Poses are on Rigid3Manifold; fixed keyframes, landmarks and extra blocks are constant. The
  /// problem does not own cost functions, losses and manifolds: AddResidualBlock() keeps them.
  ceres::Problem* problem();

  /// The parameter block of a keyframe, landmark or extra block, or of the Manhattan axes. Throws
  /// std::invalid_argument if the window does not have it.
  double* Block(const BlockId& block);

  /// Adds a residual block over blocks of the window or the caller's own, and takes ownership of
  /// `cost` and `loss` (null: none).
  ceres::ResidualBlockId AddResidualBlock(ceres::CostFunction* cost, ceres::LossFunction* loss,
                                          const std::vector<double*>& blocks);

  /// Elimination groups of the Schur complement: points and most lines in group 0; all others in
  /// group 1, such as poses, lines that pairs couple with an eliminated line, and the blocks of
  /// custom factors and of residual blocks that were added.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const;

  /// Options of Ceres for this problem: sparse Schur complement by EliminationOrdering(), one
  /// thread, silent. Eigen factorises, or SuiteSparse with kCeresSuiteSparse. Call it after the
  /// last AddResidualBlock().
  ceres::Solver::Options SolverOptions(int max_iterations) const;

  /// Writes the parameter blocks to *data. Throws std::invalid_argument if it has other keyframes,
  /// landmarks or extra blocks than the window, and std::runtime_error, leaving *data unchanged, if
  /// a value is not valid, as one that is not finite.
  void WriteBack(WindowData* data) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace msc_vo
