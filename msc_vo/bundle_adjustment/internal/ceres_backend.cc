// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"

#include "msc_vo/bundle_adjustment/window_problem.h"

namespace msc_vo {

bool IsAvailable(BundleAdjustmentSolver solver) {
  switch (solver) {
    case BundleAdjustmentSolver::kBlockSchur:
      break;
    case BundleAdjustmentSolver::kCeres:
      return ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::EIGEN_SPARSE);
    case BundleAdjustmentSolver::kCeresSuiteSparse:
      return ceres::IsSparseLinearAlgebraLibraryTypeAvailable(ceres::SUITE_SPARSE);
  }
  return true;
}

MinimizerReport MinimizeWithCeres(const BundleAdjustmentOptions& options, const WindowData& data,
                                  const WindowTerms& terms, int max_iterations,
                                  WindowState* state) {
  WindowProblem window(options, data, terms, state);
  ceres::Solver::Summary summary;
  ceres::Solve(window.SolverOptions(max_iterations), window.problem(), &summary);
  MinimizerReport report;
  report.usable = summary.IsSolutionUsable();
  // The first entry is the evaluation before the first step.
  report.num_iterations = static_cast<int>(summary.iterations.size()) - 1;
  for (const ceres::IterationSummary& iteration : summary.iterations) {
    report.num_accepted += iteration.iteration > 0 && iteration.step_is_successful;
  }
  report.schur_structure = "Ceres, " + summary.schur_structure_used;
  report.message = summary.message;
  return report;
}

}  // namespace msc_vo
