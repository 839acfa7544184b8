// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axes_estimator.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

// Keyframes in the map before the first refinement, so that lines have several views.
constexpr int kMinKeyframes = 2;
// Lines near the axes before a refinement: twelve equations for three unknowns.
constexpr int kMinAxisLines = 6;
// Factor by which the number of lines near the axes grows between refinements.
constexpr double kMinGrowth = 1.1;
// Smallest fraction of the map's lines on the axes; coarse axes below it fit one keyframe, not the
// scene, and are dropped. Half of what the keyframe that they were found in had to show.
constexpr double kMinLineRatio = 0.25;
// Largest rotation by a refinement, radians; a larger one contradicts the axes so far. Three sigmas
// of coarse axes with a real sensor.
constexpr double kMaxCorrection = DegreesToRadians(4.0);

}  // namespace

const char* ToString(AxesState state) {
  return EnumName<AxesState::kRefined>(state, {"none", "coarse", "refined"});
}

void AxesEstimator::Propose(const Eigen::Quaterniond& world_from_axes) {
  if (state_ != AxesState::kNone) return;
  state_ = AxesState::kCoarse;
  world_from_axes_ = world_from_axes.normalized();
  sigma_ = kCoarseSigma;
  num_axis_lines_tried_ = 0;
}

void AxesEstimator::Update(const AxesSupport& support) {
  support_ = support;
  const bool is_tested =
      support.num_keyframes >= kMinKeyframes && support.num_lines >= kMinAxisLines;
  if (state_ == AxesState::kCoarse && is_tested &&
      support.num_axis_lines < kMinLineRatio * support.num_lines) {
    Drop();
  }
}

bool AxesEstimator::RefinementDue() const {
  return state_ != AxesState::kNone && support_.num_keyframes >= kMinKeyframes &&
         support_.num_axis_lines >= kMinAxisLines &&
         support_.num_axis_lines >= kMinGrowth * num_axis_lines_tried_;
}

bool AxesEstimator::Refine(const Eigen::Quaterniond& world_from_axes,
                           const Eigen::Matrix3d& covariance) {
  if (!RefinementDue()) throw std::invalid_argument("AxesEstimator::Refine: none was due");
  const double correction = world_from_axes_.angularDistance(world_from_axes.normalized());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  const double sigma = std::sqrt(eigen.eigenvalues().z());
  // The negation also rejects NaN.
  if (!(correction <= kMaxCorrection && sigma <= kMaxCorrection)) {
    RejectRefinement();
    return false;
  }
  state_ = AxesState::kRefined;
  world_from_axes_ = world_from_axes.normalized();
  sigma_ = sigma;
  num_axis_lines_tried_ = support_.num_axis_lines;
  ++num_refinements_;
  return true;
}

void AxesEstimator::RejectRefinement() {
  if (!RefinementDue())
    throw std::invalid_argument("AxesEstimator::RejectRefinement: none was due");
  num_axis_lines_tried_ = support_.num_axis_lines;
  if (state_ == AxesState::kCoarse) Drop();
}

void AxesEstimator::Restore(const Eigen::Quaterniond& world_from_axes, double sigma) {
  state_ = sigma < kCoarseSigma ? AxesState::kRefined : AxesState::kCoarse;
  world_from_axes_ = world_from_axes.normalized();
  sigma_ = sigma;
}

void AxesEstimator::Drop() {
  state_ = AxesState::kNone;
  world_from_axes_ = Eigen::Quaterniond::Identity();
  sigma_ = 0.0;
  num_axis_lines_tried_ = 0;
}

}  // namespace msc_vo
