// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "msc_vo/bundle_adjustment/internal/window_step.h"

namespace msc_vo {

namespace {

// Radius of the trust region, the inverse of the damping relative to the diagonal of the Hessian.
// Rules and constants are those of Ceres.
class TrustRegion {
 public:
  double radius() const { return radius_; }
  bool IsEmpty() const { return radius_ < 1e-32; }

  // `gain`: ratio of actual to predicted decrease of the cost.
  void Accept(double gain) {
    radius_ = std::min(1e16, radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3)));
    shrinkage_ = 2.0;
  }
  void Reject() {
    radius_ /= shrinkage_;
    shrinkage_ *= 2.0;
  }

 private:
  double radius_ = 1e4;
  double shrinkage_ = 2.0;
};

constexpr double kMinGain = 1e-3;            // least gain of an accepted step
constexpr double kFunctionTolerance = 1e-6;  // relative change of the cost at convergence

// Infinite where a factor is undefined.
double CostAndEquations(const BlockStructure& structure, const WindowTerms& terms,
                        const WindowState& state, WindowEquations* equations) {
  return Linearize(structure, terms, state, equations) ? equations->cost
                                                       : std::numeric_limits<double>::infinity();
}

}  // namespace

MinimizerReport MinimizeWithBlockSchur(const BlockStructure& structure, const WindowTerms& terms,
                                       int max_iterations, const WindowStageObserver& enter_stage,
                                       WindowState* state) {
  const auto enter = [&enter_stage](WindowStage stage) {
    if (enter_stage) enter_stage(stage);
  };
  MinimizerReport report;
  report.schur_structure = "block Schur, " + std::to_string(structure.num_poses) + " poses, " +
                           std::to_string(structure.num_reduced_lines) + " line directions";
  WindowEquations equations, next;  // at the state, and after a step
  enter(WindowStage::kLinearize);
  if (!Linearize(structure, terms, *state, &equations)) {
    report.message = "a factor is undefined or the cost is not finite at the initial state";
    return report;
  }
  report.usable = true;
  report.message = "iteration limit reached";
  TrustRegion region;
  WindowStep step;
  for (; report.num_iterations < max_iterations && !region.IsEmpty(); ++report.num_iterations) {
    enter(WindowStage::kStep);
    if (!SolveStep(structure, equations, region.radius(), &step) || step.model_decrease < 0.0) {
      region.Reject();
      continue;
    }
    WindowState candidate = TakeStep(structure, *state, step);
    enter(WindowStage::kLinearize);
    // Derivatives after the last step are not needed.
    const bool is_last = report.num_iterations + 1 == max_iterations;
    const double cost =
        is_last ? Cost(terms, candidate) : CostAndEquations(structure, terms, candidate, &next);
    const double decrease = equations.cost - cost;
    if (std::abs(decrease) <= kFunctionTolerance * equations.cost) {
      // Like Ceres, do not take the last step: outlier rejection may depend on it.
      report.message = "converged";
      break;
    }
    if (decrease >= kMinGain * step.model_decrease) {
      region.Accept(decrease / step.model_decrease);
      ++report.num_accepted;
      *state = std::move(candidate);
      std::swap(equations, next);
    } else {
      region.Reject();
    }
  }
  return report;
}

}  // namespace msc_vo
