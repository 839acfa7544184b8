// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/window_builder.h"

#include "msc_vo/factors/chain_rule_cost.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_anchor.h"
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
  for (const double s : ChiSquares()) {
    double rho[3] = {s, 1.0, 0.0};
    if (loss != nullptr) loss->Evaluate(s, rho);
    cost += 0.5 * rho[0];
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
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    double* line = state_->LineBlock(i);
    if (data_.lines[i].fixed || !problem_.HasParameterBlock(line)) continue;
    ceres::CostFunction* cost =
        LineAnchor::Create(data_.lines[i].segment, options_.line_anchor_sigma);
    problem_.AddResidualBlock(cost, nullptr, line);
    line_anchor.blocks.push_back({cost, {line, nullptr}, static_cast<int>(i)});
  }
}

// Shifting or turning the whole window changes no residual: six numbers are free. They are held by
// the poses of the fixed keyframes (at least one; the observers outside the window, usually), and
// by nothing else: no prior, no constant coordinate. A free pose moves on Rigid3Manifold.
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

std::shared_ptr<ceres::ParameterBlockOrdering> WindowBuilder::EliminationOrdering() const {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](double* block, int group) {
    if (problem_.HasParameterBlock(block)) ordering->AddElementToGroup(block, group);
  };
  for (size_t i = 0; i < data_.points.size(); ++i) add(state_->PointBlock(i), 0);
  for (size_t i = 0; i < data_.lines.size(); ++i) add(state_->LineBlock(i), 0);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) add(state_->PoseBlock(i), 1);
  return ordering;
}

}  // namespace msc_vo
