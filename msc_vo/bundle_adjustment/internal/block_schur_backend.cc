// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace msc_vo {

namespace {

constexpr double kMinGain = 1e-3;            // least gain of an accepted step
constexpr double kFunctionTolerance = 1e-6;  // relative change of the cost at convergence

// Infinite where a factor is undefined.
double CostAndEquations(const BlockStructure& structure, const WindowTerms& terms,
                        const WindowState& state, WindowEquations* equations) {
  return Linearize(structure, terms, state, equations) ? equations->cost
                                                       : std::numeric_limits<double>::infinity();
}

}  // namespace

void TrustRegion::Accept(double gain) {
  radius_ = std::min(1e16, radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3)));
  shrinkage_ = 2.0;
}

void TrustRegion::Reject() {
  radius_ /= shrinkage_;
  shrinkage_ *= 2.0;
}

BlockSchurMinimizer::BlockSchurMinimizer(BlockStructure structure, const WindowTerms& terms,
                                         int max_iterations, WindowStageObserver enter_stage,
                                         WindowState* state)
    : structure_(std::move(structure)),
      terms_(terms),
      max_iterations_(max_iterations),
      enter_stage_(std::move(enter_stage)),
      state_(state) {
  report_.schur_structure = "block Schur, " + std::to_string(structure_.num_poses) + " poses, " +
                            std::to_string(structure_.num_reduced_lines) + " line directions";
}

bool BlockSchurMinimizer::Advance() {
  if (!report_.usable) {
    EvaluateInitialState();
  } else if (!has_step_) {
    ComputeStep();
  } else if (!EvaluateStep()) {
    return false;
  }
  return report_.usable && report_.num_iterations < max_iterations_ && !region_.IsEmpty();
}

void BlockSchurMinimizer::Enter(WindowStage stage) const {
  if (enter_stage_) enter_stage_(stage);
}

void BlockSchurMinimizer::EvaluateInitialState() {
  Enter(WindowStage::kLinearize);
  report_.usable = Linearize(structure_, terms_, *state_, &equations_);
  report_.message = report_.usable
                        ? "iteration limit reached"
                        : "a factor is undefined or the cost is not finite at the initial state";
}

void BlockSchurMinimizer::ComputeStep() {
  Enter(WindowStage::kStep);
  has_step_ =
      SolveStep(structure_, equations_, region_.radius(), &step_) && !(step_.model_decrease < 0.0);
  if (has_step_) return;
  region_.Reject();
  ++report_.num_iterations;
}

bool BlockSchurMinimizer::EvaluateStep() {
  has_step_ = false;
  WindowState candidate = TakeStep(structure_, *state_, step_);
  Enter(WindowStage::kLinearize);
  // Derivatives after the last step are not needed.
  const bool is_last = report_.num_iterations + 1 == max_iterations_;
  const double cost =
      is_last ? Cost(terms_, candidate) : CostAndEquations(structure_, terms_, candidate, &next_);
  const double decrease = equations_.cost - cost;
  if (std::abs(decrease) <= kFunctionTolerance * equations_.cost) {
    // Like Ceres, do not take the last step: outlier rejection may depend on it.
    report_.message = "converged";
    return false;
  }
  if (decrease >= kMinGain * step_.model_decrease) {
    region_.Accept(decrease / step_.model_decrease);
    ++report_.num_accepted;
    *state_ = std::move(candidate);
    std::swap(equations_, next_);
  } else {
    region_.Reject();
  }
  ++report_.num_iterations;
  return true;
}

}  // namespace msc_vo
