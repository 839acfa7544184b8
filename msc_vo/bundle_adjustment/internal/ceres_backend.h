// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

// Whether the Ceres that we are linked with can do it.
bool IsAvailable(BundleAdjustmentSolver solver);

// The sum of factors of a window as a Ceres problem over the numbers in `state`. All arguments must
// outlive it.
class CeresBackend {
 public:
  CeresBackend(const BundleAdjustmentOptions& options, const WindowData& data,
               const WindowTerms& terms, WindowState* state);

  ceres::Problem* problem() { return &problem_; }
  // Landmarks are eliminated first (group 0), then poses (group 1): the Schur complement. Lines of
  // one pair cannot both be in group 0 (LinesInReducedSystem).
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const;

  MinimizerReport Minimize(int max_iterations);

 private:
  template <typename Term>
  void AddTerm(const Term& term);
  void HoldGauge();

  const BundleAdjustmentOptions& options_;
  const WindowData& data_;
  const WindowTerms& terms_;
  WindowState* state_;
  Rigid3Manifold pose_manifold_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  ceres::Problem problem_;  // last: it goes before what it points to
};

}  // namespace msc_vo
