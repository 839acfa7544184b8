// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/block_schur_backend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "msc_vo/bundle_adjustment/internal/schur_complement.h"

namespace msc_vo {

namespace {

// Size of the region in which the quadratic model is trusted: the inverse of the relative damping.
// Rules and constants are those of Ceres, so that both minimisers go the same way.
class TrustRegion {
 public:
  double radius() const { return radius_; }
  bool IsGone() const { return radius_ < 1e-32; }

  // `gain`: decrease of the cost over the model's.
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

constexpr double kMinGain = 1e-3;            // a step that gains less is not taken
constexpr double kFunctionTolerance = 1e-6;  // relative change of the cost at which it has arrived

// Not finite where a term is not.
double CostAndEquations(const WindowStructure& structure, const WindowTerms& terms,
                        const WindowState& state, WindowEquations* equations) {
  return Linearize(structure, terms, state, equations) ? equations->cost
                                                       : std::numeric_limits<double>::infinity();
}

// Landmarks that a step takes behind a camera that sees them, where no term is defined, stay where
// they were before it: their depth is hardly known, which is no reason to refuse all other steps.
template <int Points, typename AnySighting, typename Block>
void KeepInFront(const std::vector<AnySighting>& sightings, const std::vector<int>& unknown,
                 const WindowState& before, const Block& block, WindowState* moved) {
  for (const AnySighting& s : sightings) {
    if (unknown[s.landmark] < 0) continue;
    double* const landmark = block(moved, s.landmark);
    const Rigid3 cam_from_world = moved->Pose(s.keyframe);
    for (int k = 0; k < Points; ++k) {
      const Eigen::Vector3d x_in_cam = cam_from_world * Eigen::Vector3d(landmark + 3 * k);
      if (x_in_cam.z() >= kMinCameraDepth) continue;
      std::copy_n(block(&before, s.landmark), 3 * Points, landmark);
      break;
    }
  }
}

WindowState Step(const WindowStructure& structure, const WindowState& state,
                 const WindowStep& step) {
  WindowState moved = Moved(structure, state, step);
  KeepInFront<1>(
      structure.point_sightings, structure.point, state,
      [](auto* s, size_t i) { return s->PointBlock(i); }, &moved);
  KeepInFront<2>(
      structure.line_sightings, structure.line, state,
      [](auto* s, size_t i) { return s->LineBlock(i); }, &moved);
  return moved;
}

}  // namespace

MinimizerReport MinimizeWindow(const WindowStructure& structure, const WindowTerms& terms,
                               int max_iterations, const WindowStageObserver& enter_stage,
                               WindowState* state) {
  const auto enter = [&enter_stage](WindowStage stage) {
    if (enter_stage) enter_stage(stage);
  };
  MinimizerReport report;
  report.schur_structure = "block Schur, " + std::to_string(structure.num_poses) + " poses, " +
                           std::to_string(structure.num_reduced_lines) + " line directions";
  // Equations at the present state, and at the one that a step leads to.
  WindowEquations equations, next;
  enter(WindowStage::kLinearize);
  if (!Linearize(structure, terms, *state, &equations)) {
    report.message = "a term is not defined, or not finite, at the start";
    return report;
  }
  report.usable = true;
  report.message = "as many iterations as allowed";
  TrustRegion region;
  WindowStep step;
  for (; report.num_iterations < max_iterations && !region.IsGone(); ++report.num_iterations) {
    enter(WindowStage::kStep);
    if (!SolveStep(structure, equations, region.radius(), &step) || step.model_decrease < 0.0) {
      region.Reject();
      continue;
    }
    WindowState candidate = Step(structure, *state, step);
    enter(WindowStage::kLinearize);
    // No step follows the last one: its derivatives would be of no use.
    const bool is_last = report.num_iterations + 1 == max_iterations;
    const double cost =
        is_last ? Cost(terms, candidate) : CostAndEquations(structure, terms, candidate, &next);
    const double decrease = equations.cost - cost;
    if (std::abs(decrease) <= kFunctionTolerance * equations.cost) {
      // As Ceres, not taking this last step: what is rejected next may hang on it.
      report.message = "converged";
      break;
    }
    if (decrease >= kMinGain * step.model_decrease) {
      region.Accept(decrease / step.model_decrease);
      *state = std::move(candidate);
      std::swap(equations, next);
    } else {
      region.Reject();
    }
  }
  return report;
}

}  // namespace msc_vo
