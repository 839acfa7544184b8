// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/window_builder.h"

#include <algorithm>
#include <utility>

#include "msc_vo/factors/chain_rule_cost.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_anchor.h"
#include "msc_vo/factors/manhattan_axis_alignment.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"
#include "msc_vo/factors/point_reprojection.h"

namespace msc_vo {

namespace {

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  // Losses and the manifold are shared between blocks.
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  // ValidateWindow has looked already.
  options.disable_all_safety_checks = true;
  return options;
}

std::unique_ptr<ceres::LossFunction> Huber(const TermOptions& term) {
  return std::make_unique<ceres::HuberLoss>(term.huber);
}

}  // namespace

std::vector<double> WindowTerm::ChiSquares() const {
  std::vector<double> chi_squares;
  chi_squares.reserve(blocks.size());
  Eigen::VectorXd residual;
  for (const Block& block : blocks) {
    residual.resize(block.cost->num_residuals());
    // Cannot fail: the solver only accepts values at which every block is defined.
    block.cost->Evaluate(block.parameters.data(), residual.data(), nullptr);
    chi_squares.push_back(residual.squaredNorm());
  }
  return chi_squares;
}

double WindowTerm::Cost() const {
  double cost = 0.0;
  const std::vector<double> chi_squares = ChiSquares();
  for (size_t i = 0; i < blocks.size(); ++i) {
    const double s = chi_squares[i];
    double rho[3] = {s, 1.0, 0.0};
    if (loss != nullptr) loss->Evaluate(s, rho);
    cost += 0.5 * (blocks[i].count * rho[0]);
  }
  return cost;
}

WindowBuilder::WindowBuilder(const WindowOptions& options, const WindowData& data,
                             const WindowIndex& index, const WindowActivity& activity,
                             WindowState* state)
    : options_(options),
      data_(data),
      index_(index),
      activity_(activity),
      state_(state),
      problem_(ProblemOptions()) {
  AddPointReprojections();
  AddPointDepths();
  AddLineReprojections();
  AddLineDepths();
  AddLineAnchors();
  // After the observations: they say which lines are there to be bound.
  AddParallelPairs();
  AddPerpendicularPairs();
  AddAxisAlignments();
  HoldGauge();
}

template <typename Factor>
void WindowBuilder::AddBlock(const Factor& factor, double* pose, double* landmark, int observation,
                             WindowTerm* term) {
  auto* cost = new ChainRuleCost<Factor>(factor);
  problem_.AddResidualBlock(cost, term->loss.get(), pose, landmark);
  term->blocks.push_back({cost, {pose, landmark}, observation});
}

LineSegment3 WindowBuilder::LineInCamera(const WindowIndex::Link& link) const {
  return state_->Pose(link.keyframe) * state_->Line(link.landmark);
}

void WindowBuilder::AddPointReprojections() {
  if (!options_.point_reprojection.enabled) return;
  point_reprojection.loss = Huber(options_.point_reprojection);
  for (size_t i = 0; i < index_.points.size(); ++i) {
    if (!activity_.points[i].reprojection) continue;
    const WindowIndex::Link& link = index_.points[i];
    const WindowData::PointObservation& o = data_.point_observations[i];
    AddBlock(PointReprojection(data_.camera, o.pixel, o.sigma), state_->PoseBlock(link.keyframe),
             state_->PointBlock(link.landmark), static_cast<int>(i), &point_reprojection);
  }
}

void WindowBuilder::AddPointDepths() {
  if (!options_.point_depth.enabled) return;
  point_depth.loss = Huber(options_.point_depth);
  for (size_t i = 0; i < index_.points.size(); ++i) {
    const WindowIndex::Link& link = index_.points[i];
    const WindowData::PointObservation& o = data_.point_observations[i];
    if (!activity_.points[i].depth) continue;
    AddBlock(DepthReprojection(o.inverse_depth, o.inverse_depth_sigma),
             state_->PoseBlock(link.keyframe), state_->PointBlock(link.landmark),
             static_cast<int>(i), &point_depth);
  }
}

void WindowBuilder::AddLineReprojections() {
  if (!options_.line_reprojection.enabled) return;
  line_reprojection.loss = Huber(options_.line_reprojection);
  for (size_t i = 0; i < index_.lines.size(); ++i) {
    if (!activity_.lines[i].reprojection) continue;
    const WindowIndex::Link& link = index_.lines[i];
    const WindowData::LineObservation& o = data_.line_observations[i];
    AddBlock(MakeLineReprojection(data_.camera, o.segment, o.sigma, LineInCamera(link)),
             state_->PoseBlock(link.keyframe), state_->LineBlock(link.landmark),
             static_cast<int>(i), &line_reprojection);
  }
}

void WindowBuilder::AddLineDepths() {
  if (!options_.line_depth.enabled) return;
  line_depth.loss = Huber(options_.line_depth);
  for (size_t i = 0; i < index_.lines.size(); ++i) {
    if (!activity_.lines[i].depth) continue;
    const WindowIndex::Link& link = index_.lines[i];
    const WindowData::LineObservation& o = data_.line_observations[i];
    AddBlock(MakeLineDepthReprojection(data_.camera, o.segment, o.depth, LineInCamera(link)),
             state_->PoseBlock(link.keyframe), state_->LineBlock(link.landmark),
             static_cast<int>(i), &line_depth);
  }
}

// For every line that an observation could move.
void WindowBuilder::AddLineAnchors() {
  if (!options_.line_anchor) return;
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    if (!IsFree(static_cast<int>(i))) continue;
    double* line = state_->LineBlock(i);
    ceres::CostFunction* cost =
        LineAnchor::Create(data_.lines[i].segment, options_.line_anchor_sigma);
    problem_.AddResidualBlock(cost, nullptr, line);
    line_anchor.blocks.push_back({cost, {line, nullptr}, static_cast<int>(i)});
  }
}

// An observation could move it.
bool WindowBuilder::IsFree(int line) const {
  return !data_.lines[line].fixed && problem_.HasParameterBlock(state_->LineBlock(line));
}

// n identical terms: the loss times n. The term's own loss if n is 1.
ceres::LossFunction* WindowBuilder::CountedLoss(const WindowTerm& term, int count) {
  if (count == 1) return term.loss.get();
  counted_losses_.push_back(
      std::make_unique<ceres::ScaledLoss>(term.loss.get(), count, ceres::DO_NOT_TAKE_OWNERSHIP));
  return counted_losses_.back().get();
}

template <typename Factor>
void WindowBuilder::AddPairs(const TermOptions& options,
                             const std::vector<WindowData::LinePair>& pairs,
                             const std::vector<WindowIndex::Pair>& lines,
                             const std::vector<bool>& active, WindowTerm* term) {
  if (!options.enabled) return;
  term->loss = Huber(options);
  for (size_t i = 0; i < pairs.size(); ++i) {
    double* a = state_->LineBlock(lines[i].a);
    double* b = state_->LineBlock(lines[i].b);
    if (!active[i] || !problem_.HasParameterBlock(a) || !problem_.HasParameterBlock(b)) continue;
    if (!IsFree(lines[i].a) && !IsFree(lines[i].b)) continue;
    ceres::CostFunction* cost = Factor::Create(pairs[i].sigma);
    problem_.AddResidualBlock(cost, CountedLoss(*term, pairs[i].count), a, b);
    term->blocks.push_back({cost, {a, b}, static_cast<int>(i), pairs[i].count});
  }
}

void WindowBuilder::AddParallelPairs() {
  AddPairs<ParallelLines>(options_.parallel, data_.parallel_pairs, index_.parallel,
                          activity_.parallel, &parallel);
}

void WindowBuilder::AddPerpendicularPairs() {
  AddPairs<PerpendicularLines>(options_.perpendicular, data_.perpendicular_pairs,
                               index_.perpendicular, activity_.perpendicular, &perpendicular);
}

void WindowBuilder::AddAxisAlignments() {
  if (!options_.manhattan.enabled) return;
  manhattan.loss = Huber(options_.manhattan);
  for (size_t i = 0; i < index_.alignments.size(); ++i) {
    if (!activity_.alignments[i] || !IsFree(index_.alignments[i])) continue;
    const WindowData::AxisAlignment& alignment = data_.axis_alignments[i];
    double* line = state_->LineBlock(index_.alignments[i]);
    ceres::CostFunction* cost = ManhattanAxisAlignment::Create(alignment.axis, alignment.sigma);
    problem_.AddResidualBlock(cost, manhattan.loss.get(), line);
    manhattan.blocks.push_back({cost, {line, nullptr}, static_cast<int>(i)});
  }
}

// Shifting or turning the whole window changes no residual of what it sees or of pairs: six numbers
// are free. They are held by the poses of the fixed keyframes (at least one; the observers outside
// the window, usually), and by nothing else: no prior, no constant coordinate. Alignments to axes
// tell of the rotation what a compass would, softly; they do not hold it. A free pose moves on
// Rigid3Manifold.
void WindowBuilder::HoldGauge() {
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

// Eliminating a line binds all that share a block with it; so Ceres wants the blocks of group 0
// independent of each other. Of two paired lines one at least must stay in the reduced system, at
// six unknowns each, and its cost grows with their cube. Lines with few partners are eliminated
// first (ties by position), each keeping its partners: where pairs lead to a few well-known lines,
// only those are left. Returns, for every line, whether it stays.
std::vector<bool> WindowBuilder::LinesToKeep() const {
  std::vector<std::vector<int>> partners(data_.lines.size());
  const auto connect = [&](const WindowTerm& term, const std::vector<WindowIndex::Pair>& lines) {
    for (const WindowTerm::Block& block : term.blocks) {
      const auto [a, b] = lines[block.source];
      if (!IsFree(a) || !IsFree(b)) continue;
      partners[a].push_back(b);
      partners[b].push_back(a);
    }
  };
  connect(parallel, index_.parallel);
  connect(perpendicular, index_.perpendicular);
  std::vector<std::pair<size_t, int>> by_degree;
  for (size_t i = 0; i < partners.size(); ++i) {
    by_degree.emplace_back(partners[i].size(), static_cast<int>(i));
  }
  std::sort(by_degree.begin(), by_degree.end());
  std::vector<bool> keep(partners.size(), false);
  for (const auto& [degree, line] : by_degree) {
    if (keep[line]) continue;
    for (const int partner : partners[line]) keep[partner] = true;
  }
  return keep;
}

std::shared_ptr<ceres::ParameterBlockOrdering> WindowBuilder::EliminationOrdering() const {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](double* block, int group) {
    if (problem_.HasParameterBlock(block)) ordering->AddElementToGroup(block, group);
  };
  for (size_t i = 0; i < data_.points.size(); ++i) add(state_->PointBlock(i), 0);
  const std::vector<bool> keep = LinesToKeep();
  for (size_t i = 0; i < data_.lines.size(); ++i) add(state_->LineBlock(i), keep[i] ? 1 : 0);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) add(state_->PoseBlock(i), 1);
  return ordering;
}

}  // namespace msc_vo
