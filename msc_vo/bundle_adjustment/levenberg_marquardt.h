// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

enum class LevenbergMarquardtTermination { kConverged, kIterationLimit, kFailed };

struct LevenbergMarquardtSummary {
  LevenbergMarquardtTermination termination = LevenbergMarquardtTermination::kIterationLimit;
  int num_iterations = 0;  ///< Steps that were evaluated.
};

/// Levenberg-Marquardt with Marquardt's damping for small problems that start close to their
/// minimum: pose optimization and frame structure. Takes at most `max_iterations` steps.
///
/// The damping lambda is relative to the diagonal of the Hessian H. A step that does not increase
/// the cost is taken and lambda is divided by 10; otherwise lambda is multiplied by 100. A step
/// with step^T H step < `min_squared_step` is the last one. That norm is in standard deviations of
/// the estimate.
///
/// `Problem` holds the estimate and its normal equations:
///
///   // Evaluates the initial estimate. Returns false if it is undefined there.
///   bool Linearize();
///   // Computes a step and step^T H step. Returns false if they are not finite.
///   bool SolveStep(double lambda, double* squared_step);
///   // Evaluates the estimate after the step and moves to it unless the cost increases. Returns
///   // whether it moved. The loop needs no derivatives after the last step.
///   bool TakeStep(bool is_last);
///
/// Local bundle adjustment has a loop of its own (BlockSchurMinimizer): it follows the
/// trust-region rules of Ceres, which accept a step by the ratio of actual to predicted decrease
/// and stop at a small decrease of the cost, so that all of its solvers take the same steps.
template <typename Problem>
LevenbergMarquardtSummary MinimizeByLevenbergMarquardt(int max_iterations, double min_squared_step,
                                                       Problem* problem) {
  LevenbergMarquardtSummary summary;
  const auto end = [&summary](LevenbergMarquardtTermination termination) {
    summary.termination = termination;
    return summary;
  };
  if (!problem->Linearize()) return end(LevenbergMarquardtTermination::kFailed);
  double lambda = 1e-4;
  while (summary.num_iterations < max_iterations) {
    double squared_step = 0.0;
    if (!problem->SolveStep(lambda, &squared_step)) {
      return end(LevenbergMarquardtTermination::kFailed);
    }
    ++summary.num_iterations;
    const bool is_last = squared_step < min_squared_step;
    const bool moved = problem->TakeStep(is_last);
    // At the minimum, rounding may refuse a step of negligible length.
    if (is_last) return end(LevenbergMarquardtTermination::kConverged);
    lambda *= moved ? 0.1 : 100.0;
  }
  return end(LevenbergMarquardtTermination::kIterationLimit);
}

}  // namespace msc_vo
