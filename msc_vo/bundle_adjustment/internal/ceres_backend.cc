// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"

#include <algorithm>

#include <ceres/solver.h>

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"
#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/analytic_line_pair_cost_function.h"
#include "msc_vo/factors/observation_cost_function.h"

namespace msc_vo {

namespace {

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  // CeresBackend keeps everything: the problem would count references in tables, which takes longer
  // than adding the residual blocks.
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  // ValidateWindow has checked the data.
  options.disable_all_safety_checks = true;
  return options;
}

// Cost function with analytic derivatives, where a factor type has one.
template <typename Factor, int Points, int RowsPerPoint>
ceres::CostFunction* Analytic(const CameraFactor<Factor, Points, RowsPerPoint>& factor) {
  return new AnalyticCostFunction<Factor>(static_cast<const Factor&>(factor));
}
template <typename Factor, int Rows>
ceres::CostFunction* Analytic(const LinePairFactor<Factor, Rows>& factor) {
  return new AnalyticLinePairCostFunction<Factor>(static_cast<const Factor&>(factor));
}
ceres::CostFunction* Analytic(const LineEndpointPrior& factor) {
  return LineEndpointPrior::Create(factor);
}
ceres::CostFunction* Analytic(const PosePrior& factor) { return PosePrior::Create(factor); }
ceres::CostFunction* Analytic(const ManhattanAxisAlignment& factor) {
  return ManhattanAxisAlignment::Create(factor);
}

ceres::SparseLinearAlgebraLibraryType SparseLibrary(BundleAdjustmentSolver solver) {
  return solver == BundleAdjustmentSolver::kCeresSuiteSparse ? ceres::SUITE_SPARSE
                                                             : ceres::EIGEN_SPARSE;
}

}  // namespace

bool IsAvailable(BundleAdjustmentSolver solver) {
  return solver == BundleAdjustmentSolver::kBlockSchur ||
         solver == BundleAdjustmentSolver::kCeresDenseSchur ||
         ceres::IsSparseLinearAlgebraLibraryTypeAvailable(SparseLibrary(solver));
}

CeresBackend::CeresBackend(const BundleAdjustmentOptions& options, const WindowData& data,
                           const WindowTerms& terms, WindowState* state)
    : options_(options), data_(data), terms_(terms), state_(state), problem_(ProblemOptions()) {
  AddObservations(terms.Of<PointReprojection>(), terms.Of<DepthReprojection>());
  AddObservations(terms.Of<LineReprojection>(), terms.Of<LineDepthReprojection>());
  ForEachTerm(terms, [this](const auto& term, const auto& blocks) {
    if constexpr (!kIsOfObservation<typename std::decay_t<decltype(term)>::Factor>) AddTerm(blocks);
  });
  HoldGauge();
}

ceres::LossFunction* CeresBackend::LossOf(const HuberLoss& loss, int count) {
  if (loss.threshold == 0.0 && count == 1) return nullptr;
  std::unique_ptr<ceres::LossFunction>& kept = losses_[{loss.threshold, count}];
  if (kept == nullptr) {
    kept = std::make_unique<ceres::ScaledLoss>(new ceres::HuberLoss(loss.threshold), count,
                                               ceres::TAKE_OWNERSHIP);
  }
  return kept.get();
}

template <typename Parameters>
void CeresBackend::AddResidualBlock(ceres::CostFunction* cost, ceres::LossFunction* loss,
                                    const Parameters& parameters) {
  cost_functions_.emplace_back(cost);
  problem_.AddResidualBlock(cost, loss, parameters.data(), static_cast<int>(parameters.size()));
}

template <typename Factor>
void CeresBackend::AddBlock(const WindowTerm<Factor>& term,
                            const typename WindowTerm<Factor>::Block& block) {
  AddResidualBlock(
      options_.analytic_jacobians ? Analytic(block.factor) : Factor::Create(block.factor),
      LossOf(term.loss, block.count), ParametersOf<Factor>(state_, block));
}

template <typename Factor>
void CeresBackend::AddTerm(const WindowTerm<Factor>& term) {
  for (const auto& block : term.blocks) AddBlock(term, block);
}

// Both terms are in the order of the observations.
template <typename Reprojection, typename Depth>
void CeresBackend::AddObservations(const WindowTerm<Reprojection>& reprojection,
                                   const WindowTerm<Depth>& depth) {
  if (!options_.analytic_jacobians) {
    AddTerm(reprojection);
    AddTerm(depth);
    return;
  }
  auto next_depth = depth.blocks.begin();
  const auto end = depth.blocks.end();
  for (const auto& block : reprojection.blocks) {
    for (; next_depth != end && next_depth->source < block.source; ++next_depth) {
      AddBlock(depth, *next_depth);
    }
    if (next_depth == end || next_depth->source > block.source) {
      AddBlock(reprojection, block);
      continue;
    }
    AddResidualBlock(new ObservationCostFunction<Reprojection, Depth>(
                         block.factor, reprojection.loss, next_depth->factor, depth.loss),
                     nullptr, ParametersOf<Reprojection>(state_, block));
    ++next_depth;
  }
  for (; next_depth != end; ++next_depth) AddBlock(depth, *next_depth);
}

// Ceres takes pointers to non-const cost functions, losses and manifolds, but calls their const
// functions only.
void CeresBackend::AddTerm(const WindowTerm<CustomFactor>& term) {
  for (const auto& block : term.blocks) {
    std::vector<double*> parameters;
    for (const StateBlock& b : block.parameters) parameters.push_back(state_->Block(b));
    problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(block.factor->cost.get()),
                              const_cast<ceres::LossFunction*>(block.factor->loss.get()),
                              parameters.data(), static_cast<int>(parameters.size()));
  }
  for (size_t i = 0; i < state_->NumExtra(); ++i) {
    const StateBlock extra{BlockKind::kExtra, static_cast<int>(i)};
    double* block = state_->Block(extra);
    if (!problem_.HasParameterBlock(block)) continue;
    problem_.SetManifold(block, const_cast<ceres::Manifold*>(state_->ManifoldOf(extra)));
    if (IsFixed(data_, extra)) problem_.SetParameterBlockConstant(block);
  }
}

// A rigid motion of the whole window leaves observation and pair residuals unchanged: six degrees
// of freedom. They are fixed by constant keyframe poses, usually observers outside the window, or
// by pose priors. Axis alignments constrain the rotation softly and are not counted on. Poses are
// on Rigid3Manifold.
void CeresBackend::HoldGauge() {
  const auto hold = [this](bool fixed, double* block) {
    if (fixed && problem_.HasParameterBlock(block)) problem_.SetParameterBlockConstant(block);
  };
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    double* pose = state_->PoseBlock(i);
    if (problem_.HasParameterBlock(pose)) problem_.SetManifold(pose, &pose_manifold_);
    hold(data_.keyframes[i].fixed, pose);
  }
  for (size_t i = 0; i < data_.points.size(); ++i)
    hold(data_.points[i].fixed, state_->PointBlock(i));
  for (size_t i = 0; i < data_.lines.size(); ++i) hold(data_.lines[i].fixed, state_->LineBlock(i));
}

std::shared_ptr<ceres::ParameterBlockOrdering> CeresBackend::EliminationOrdering() const {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](double* block, int group) {
    if (problem_.HasParameterBlock(block)) ordering->AddElementToGroup(block, group);
  };
  for (size_t i = 0; i < data_.points.size(); ++i) add(state_->PointBlock(i), 0);
  std::vector<WindowIndex::Pair> pairs;
  ForEachPair(terms_, [&](int a, int b) {
    if (!data_.lines[a].fixed && !data_.lines[b].fixed) pairs.push_back({a, b});
  });
  const std::vector<bool> in_reduced_system =
      LinesInReducedSystem(static_cast<int>(data_.lines.size()), pairs);
  for (size_t i = 0; i < data_.lines.size(); ++i)
    add(state_->LineBlock(i), in_reduced_system[i] ? 1 : 0);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) add(state_->PoseBlock(i), 1);
  for (const auto& block : terms_.Of<CustomFactor>().blocks) {
    for (const StateBlock& b : block.parameters) add(state_->Block(b), 1);  // moves landmarks
  }
  return ordering;
}

MinimizerReport CeresBackend::Minimize(int max_iterations) {
  ceres::Solver::Options options;
  options.max_num_iterations = max_iterations;
  // The damping is relative to the diagonal of the Hessian, so that scaling changes no step.
  options.jacobi_scaling = false;
  if (options_.solver == BundleAdjustmentSolver::kCeresDenseSchur) {
    options.linear_solver_type = ceres::DENSE_SCHUR;
  } else {
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.sparse_linear_algebra_library_type = SparseLibrary(options_.solver);
  }
  if (options_.explicit_ordering) options.linear_solver_ordering = EliminationOrdering();
  // One thread keeps the order of summation, and so the result, deterministic.
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
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
