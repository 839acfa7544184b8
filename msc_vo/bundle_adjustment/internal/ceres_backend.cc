// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"

#include <algorithm>
#include <map>
#include <utility>

#include <ceres/solver.h>

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"
#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/analytic_line_pair_cost_function.h"

namespace msc_vo {

namespace {

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  // Losses and the manifold are shared between residual blocks.
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

// Cost function of a custom factor, which the problem must not delete.
class SharedCostFunction final : public ceres::CostFunction {
 public:
  explicit SharedCostFunction(const ceres::CostFunction& cost) : cost_(cost) {
    set_num_residuals(cost.num_residuals());
    *mutable_parameter_block_sizes() = cost.parameter_block_sizes();
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    return cost_.Evaluate(parameters, residuals, jacobians);
  }

 private:
  const ceres::CostFunction& cost_;
};

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
  AddTerm(terms.point_reprojection);
  AddTerm(terms.point_depth);
  AddTerm(terms.line_reprojection);
  AddTerm(terms.line_depth);
  AddTerm(terms.line_endpoint_prior);
  AddTerm(terms.parallel);
  AddTerm(terms.perpendicular);
  AddTerm(terms.manhattan);
  AddTerm(terms.pose_prior);
  AddCustomFactors();
  HoldGauge();
}

template <typename Term>
void CeresBackend::AddTerm(const Term& term) {
  using Factor = typename Term::Factor;
  std::map<int, ceres::LossFunction*> losses;  // by multiplicity
  const auto loss = [&](int count) -> ceres::LossFunction* {
    if (term.loss.threshold == 0.0 && count == 1) return nullptr;
    ceres::LossFunction*& it = losses[count];
    if (it == nullptr) {
      losses_.push_back(std::make_unique<ceres::ScaledLoss>(
          new ceres::HuberLoss(term.loss.threshold), count, ceres::TAKE_OWNERSHIP));
      it = losses_.back().get();
    }
    return it;
  };
  for (const auto& block : term.blocks) {
    const auto blocks = ParametersOf<Factor>(state_, block);
    ceres::CostFunction* cost =
        options_.analytic_jacobians ? Analytic(block.factor) : Factor::Create(block.factor);
    problem_.AddResidualBlock(cost, loss(block.count), blocks.data(),
                              static_cast<int>(blocks.size()));
  }
}

// Ceres takes pointers to non-const losses and manifolds, but calls their const functions only.
void CeresBackend::AddCustomFactors() {
  for (const CustomTerm::Block& block : terms_.custom.blocks) {
    std::vector<double*> parameters;
    for (const StateBlock& b : block.parameters) parameters.push_back(state_->Block(b));
    problem_.AddResidualBlock(new SharedCostFunction(*block.factor->cost),
                              const_cast<ceres::LossFunction*>(block.factor->loss.get()),
                              parameters.data(), static_cast<int>(parameters.size()));
  }
  for (size_t i = 0; i < state_->NumExtra(); ++i) {
    const StateBlock extra{StateBlock::Kind::kExtra, static_cast<int>(i)};
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
  const auto collect = [&](const auto& term) {
    for (const auto& block : term.blocks) {
      if (data_.lines[block.first].fixed || data_.lines[block.second].fixed) continue;
      pairs.push_back({block.first, block.second});
    }
  };
  collect(terms_.parallel);
  collect(terms_.perpendicular);
  const std::vector<bool> in_reduced_system =
      LinesInReducedSystem(static_cast<int>(data_.lines.size()), pairs);
  for (size_t i = 0; i < data_.lines.size(); ++i)
    add(state_->LineBlock(i), in_reduced_system[i] ? 1 : 0);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) add(state_->PoseBlock(i), 1);
  for (const CustomTerm::Block& block : terms_.custom.blocks) {
    for (const StateBlock& b : block.parameters) add(state_->Block(b), 1);  // moves landmarks
  }
  return ordering;
}

MinimizerReport CeresBackend::Minimize(int max_iterations) {
  ceres::Solver::Options options;
  options.max_num_iterations = max_iterations;
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
