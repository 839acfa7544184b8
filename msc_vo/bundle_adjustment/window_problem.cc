// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_problem.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/factors/analytic_cost_function.h"
#include "msc_vo/factors/analytic_line_pair_cost_function.h"

namespace msc_vo {

namespace {

ceres::Problem::Options ProblemOptions(bool trusted) {
  ceres::Problem::Options options;
  // WindowProblem keeps everything: Ceres would count references in tables, which takes longer than
  // adding the residual blocks.
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = trusted;
  return options;
}

// Cost function with analytic derivatives, where a factor type has one.
template <typename Factor, BlockKind Landmark, int RowsPerPoint>
ceres::CostFunction* MakeCost(const CameraFactor<Factor, Landmark, RowsPerPoint>& factor) {
  return new AnalyticCostFunction<Factor>(static_cast<const Factor&>(factor));
}
template <typename Factor, int Rows>
ceres::CostFunction* MakeCost(const LinePairFactor<Factor, Rows>& factor) {
  return new AnalyticLinePairCostFunction<Factor>(static_cast<const Factor&>(factor));
}
template <typename Factor, int Rows, BlockKind Kind>
ceres::CostFunction* MakeCost(const WindowFactor<Factor, Rows, Kind>& factor) {
  return Factor::Create(static_cast<const Factor&>(factor));
}

// Position in the window of the item with an id.
template <typename Items>
int PositionOf(const Items& items, int64_t id, const char* kind) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (items[i].id == id) return static_cast<int>(i);
  }
  throw std::invalid_argument(std::string("WindowProblem: ") + kind + " " + std::to_string(id) +
                              " is not in the window");
}

StateBlock Resolve(const WindowData& data, const BlockId& block) {
  switch (block.kind) {
    case BlockKind::kPose:
      return {block.kind, PositionOf(data.keyframes, block.id, "keyframe")};
    case BlockKind::kPoint:
      return {block.kind, PositionOf(data.points, block.id, "point")};
    case BlockKind::kLine:
      return {block.kind, PositionOf(data.lines, block.id, "line")};
    case BlockKind::kExtra:
      return {block.kind, PositionOf(data.extra_blocks, block.id, "extra block")};
    case BlockKind::kAxes:
      break;
  }
  if (!data.axes) throw std::invalid_argument("WindowProblem: the window has no Manhattan axes");
  return {BlockKind::kExtra, static_cast<int>(data.extra_blocks.size())};
}

template <typename Items>
bool HaveSameIds(const Items& a, const Items& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.id == y.id; });
}

// What the public constructor keeps of a window.
struct OwnWindow {
  OwnWindow(const BundleAdjustmentOptions& options, const WindowData& window)
      : data(window), state(data) {
    const WindowIndex index = ValidateWindow(options, data);
    terms =
        MakeWindowTerms(options, data, index, UnrejectedInlierMask(options, index, data), state);
  }
  WindowData data;
  WindowState state;
  WindowTerms terms;
};

}  // namespace

class WindowProblem::Impl {
 public:
  Impl(const BundleAdjustmentOptions& options, const WindowData& data)
      : own_(std::make_unique<OwnWindow>(options, data)),
        solver_(options.solver),
        data_(own_->data),
        terms_(own_->terms),
        state_(&own_->state),
        problem_(ProblemOptions(false)) {
    // Those without a residual block, too: the caller may add one.
    ForEachBlock([this](const StateBlock& block) {
      problem_.AddParameterBlock(state_->Block(block), state_->Size(block));
    });
    Build();
  }
  Impl(const BundleAdjustmentOptions& options, const WindowData& data, const WindowTerms& terms,
       WindowState* state)
      : solver_(options.solver),
        data_(data),
        terms_(terms),
        state_(state),
        problem_(ProblemOptions(true)) {
    Build();
  }

  ceres::Problem* problem() { return &problem_; }
  double* Block(const BlockId& block) { return state_->Block(Resolve(data_, block)); }

  ceres::ResidualBlockId Add(ceres::CostFunction* cost, ceres::LossFunction* loss,
                             const std::vector<double*>& blocks) {
    cost_functions_.emplace_back(cost);
    added_losses_.emplace_back(loss);
    return problem_.AddResidualBlock(cost, loss, blocks.data(), static_cast<int>(blocks.size()));
  }

  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const {
    const std::vector<bool> in_reduced_system = ReducedLines();
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    ForEachBlock([&](const StateBlock& block) {
      const bool is_eliminated =
          block.kind == BlockKind::kPoint ||
          (block.kind == BlockKind::kLine && !in_reduced_system[block.position]);
      Order(state_->Block(block), is_eliminated ? 0 : 1, ordering.get());
    });
    for (const auto& block : terms_.Of<CustomFactor>().blocks) {
      for (const StateBlock& b : block.parameters) Order(state_->Block(b), 1, ordering.get());
    }
    OrderAddedBlocks(ordering.get());
    return ordering;
  }

  ceres::Solver::Options SolverOptions(int max_iterations) const {
    ceres::Solver::Options options;
    options.max_num_iterations = max_iterations;
    // The damping is relative to the diagonal of the Hessian, so that scaling changes no step.
    options.jacobi_scaling = false;
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.sparse_linear_algebra_library_type =
        solver_ == BundleAdjustmentSolver::kCeresSuiteSparse ? ceres::SUITE_SPARSE
                                                             : ceres::EIGEN_SPARSE;
    options.linear_solver_ordering = EliminationOrdering();
    // One thread keeps the order of summation, and so the result, deterministic.
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    return options;
  }

  void WriteBack(WindowData* data) const {
    if (!HaveSameIds(data->keyframes, data_.keyframes) ||
        !HaveSameIds(data->points, data_.points) || !HaveSameIds(data->lines, data_.lines) ||
        !HaveSameIds(data->extra_blocks, data_.extra_blocks) ||
        data->axes.has_value() != data_.axes.has_value()) {
      throw std::invalid_argument("WindowProblem: WriteBack needs the window of the problem");
    }
    WindowData solved = *data;
    WriteState(
        *state_, [](const StateBlock&) { return true; }, &solved);
    std::string error;
    if (!HasValidState(solved, &error)) throw std::runtime_error("WindowProblem: " + error);
    *data = std::move(solved);
  }

 private:
  // In the order of the state.
  template <typename Visitor>
  void ForEachBlock(const Visitor& visit) const {
    const auto visit_all = [&visit](BlockKind kind, size_t count) {
      for (size_t i = 0; i < count; ++i) visit(StateBlock{kind, static_cast<int>(i)});
    };
    visit_all(BlockKind::kPoint, data_.points.size());
    visit_all(BlockKind::kLine, data_.lines.size());
    visit_all(BlockKind::kPose, data_.keyframes.size());
    visit_all(BlockKind::kExtra, state_->NumExtra());
  }

  void Build() {
    ForEachTerm(terms_, [this](const auto&, const auto& term) { AddTerm(term); });
    HoldGauge();
    if (own_ != nullptr) problem_.GetResidualBlocks(&own_residual_blocks_);
  }

  template <typename Factor>
  void AddTerm(const WindowTerm<Factor>& term) {
    for (const auto& block : term.blocks) {
      cost_functions_.emplace_back(MakeCost(block.factor));
      const auto parameters = ParametersOf<Factor>(state_, block);
      problem_.AddResidualBlock(cost_functions_.back().get(), LossOf(term.loss, block.count),
                                parameters.data(), static_cast<int>(parameters.size()));
    }
  }

  // Ceres takes pointers to non-const cost functions, losses and manifolds, but calls their const
  // functions only.
  void AddTerm(const WindowTerm<CustomFactor>& term) {
    for (const auto& block : term.blocks) {
      std::vector<double*> parameters;
      for (const StateBlock& b : block.parameters) parameters.push_back(state_->Block(b));
      problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(block.factor->cost.get()),
                                const_cast<ceres::LossFunction*>(block.factor->loss.get()),
                                parameters.data(), static_cast<int>(parameters.size()));
    }
  }

  // Null where no loss is needed.
  ceres::LossFunction* LossOf(const HuberLoss& loss, int count) {
    if (loss.threshold == 0.0 && count == 1) return nullptr;
    std::unique_ptr<ceres::LossFunction>& kept = losses_[{loss.threshold, count}];
    if (kept == nullptr) {
      kept = std::make_unique<ceres::ScaledLoss>(new ceres::HuberLoss(loss.threshold), count,
                                                 ceres::TAKE_OWNERSHIP);
    }
    return kept.get();
  }

  // A rigid motion of the whole window leaves observation and pair residuals unchanged: six degrees
  // of freedom. They are fixed by constant keyframe poses, usually observers outside the window, or
  // by pose priors. Axis alignments constrain the rotation softly and are not counted on. Poses are
  // on Rigid3Manifold.
  void HoldGauge() {
    ForEachBlock([this](const StateBlock& block) {
      double* const values = state_->Block(block);
      if (!problem_.HasParameterBlock(values)) return;
      const ceres::Manifold* manifold = state_->ManifoldOf(block);
      if (manifold != nullptr) {
        problem_.SetManifold(values, const_cast<ceres::Manifold*>(manifold));
      }
      if (IsFixed(data_, block)) problem_.SetParameterBlockConstant(values);
    });
  }

  std::vector<bool> ReducedLines() const {
    std::vector<WindowIndex::Pair> pairs;
    ForEachPair(terms_, [&](int a, int b) {
      if (!data_.lines[a].fixed && !data_.lines[b].fixed) pairs.push_back({a, b});
    });
    return LinesInReducedSystem(static_cast<int>(data_.lines.size()), pairs);
  }

  // Moves a block of the problem to a group.
  void Order(double* block, int group, ceres::ParameterBlockOrdering* ordering) const {
    if (problem_.HasParameterBlock(block)) ordering->AddElementToGroup(block, group);
  }

  // Only one block of a residual block can be eliminated, and the caller's are not known.
  void OrderAddedBlocks(ceres::ParameterBlockOrdering* ordering) const {
    if (own_ == nullptr) return;
    std::vector<ceres::ResidualBlockId> present;
    problem_.GetResidualBlocks(&present);
    const std::set<ceres::ResidualBlockId> own(own_residual_blocks_.begin(),
                                               own_residual_blocks_.end());
    std::vector<double*> blocks;
    for (const ceres::ResidualBlockId residual_block : present) {
      if (own.count(residual_block) > 0) continue;
      problem_.GetParameterBlocksForResidualBlock(residual_block, &blocks);
      for (double* block : blocks) Order(block, 1, ordering);
    }
    problem_.GetParameterBlocks(&blocks);
    for (double* block : blocks) {
      if (!ordering->IsMember(block)) Order(block, 1, ordering);
    }
  }

  std::unique_ptr<OwnWindow> own_;  // null: data, terms and state are the caller's
  const BundleAdjustmentSolver solver_;
  const WindowData& data_;
  const WindowTerms& terms_;
  WindowState* const state_;
  std::vector<ceres::ResidualBlockId> own_residual_blocks_;  // of the terms
  std::vector<std::unique_ptr<ceres::CostFunction>> cost_functions_;
  std::vector<std::unique_ptr<ceres::LossFunction>> added_losses_;
  // By threshold and multiplicity.
  std::map<std::pair<double, int>, std::unique_ptr<ceres::LossFunction>> losses_;
  ceres::Problem problem_;  // last, so that it is destroyed before the objects it refers to
};

WindowProblem::WindowProblem(const BundleAdjustmentOptions& options, const WindowData& data)
    : impl_(std::make_unique<Impl>(options, data)) {}
WindowProblem::WindowProblem(const BundleAdjustmentOptions& options, const WindowData& data,
                             const WindowTerms& terms, WindowState* state)
    : impl_(std::make_unique<Impl>(options, data, terms, state)) {}
WindowProblem::~WindowProblem() = default;

ceres::Problem* WindowProblem::problem() { return impl_->problem(); }
double* WindowProblem::Block(const BlockId& block) { return impl_->Block(block); }
ceres::ResidualBlockId WindowProblem::AddResidualBlock(ceres::CostFunction* cost,
                                                       ceres::LossFunction* loss,
                                                       const std::vector<double*>& blocks) {
  return impl_->Add(cost, loss, blocks);
}
std::shared_ptr<ceres::ParameterBlockOrdering> WindowProblem::EliminationOrdering() const {
  return impl_->EliminationOrdering();
}
ceres::Solver::Options WindowProblem::SolverOptions(int max_iterations) const {
  return impl_->SolverOptions(max_iterations);
}
void WindowProblem::WriteBack(WindowData* data) const { impl_->WriteBack(data); }

}  // namespace msc_vo
