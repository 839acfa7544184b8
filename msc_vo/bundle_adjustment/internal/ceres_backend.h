// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

/// Whether the linked Ceres supports a solver.
bool IsAvailable(BundleAdjustmentSolver solver);

/// Ceres problem with the terms of a window over the parameter blocks in `state`. All arguments
/// must outlive it.
class CeresBackend {
 public:
  CeresBackend(const BundleAdjustmentOptions& options, const WindowData& data,
               const WindowTerms& terms, WindowState* state);

  ceres::Problem* problem() { return &problem_; }
  /// Elimination groups of the Schur complement: points and most lines in group 0; poses, lines
  /// that LinesInReducedSystem keeps, and all blocks of custom factors in group 1.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const;

  MinimizerReport Minimize(int max_iterations);

 private:
  // One residual block per observation with analytic derivatives, one per factor otherwise.
  template <typename Reprojection, typename Depth>
  void AddObservations(const WindowTerm<Reprojection>& reprojection,
                       const WindowTerm<Depth>& depth);
  template <typename Factor>
  void AddTerm(const WindowTerm<Factor>& term);
  template <typename Factor>
  void AddBlock(const WindowTerm<Factor>& term, const typename WindowTerm<Factor>::Block& block);
  // Keeps `cost`.
  template <typename Parameters>
  void AddResidualBlock(ceres::CostFunction* cost, ceres::LossFunction* loss,
                        const Parameters& parameters);
  // Null where no loss is needed.
  ceres::LossFunction* LossOf(const HuberLoss& loss, int count);
  void AddTerm(const WindowTerm<CustomFactor>& term);
  void HoldGauge();

  const BundleAdjustmentOptions& options_;
  const WindowData& data_;
  const WindowTerms& terms_;
  WindowState* state_;
  Rigid3Manifold pose_manifold_;
  std::vector<std::unique_ptr<ceres::CostFunction>> cost_functions_;
  // By threshold and multiplicity.
  std::map<std::pair<double, int>, std::unique_ptr<ceres::LossFunction>> losses_;
  ceres::Problem problem_;  // last, so that it is destroyed before the objects it refers to
};

}  // namespace msc_vo
