// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axes_estimator.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>

namespace msc_vo {

const char* ToString(AxesState state) {
  switch (state) {
    case AxesState::kNone:
      return "none";
    case AxesState::kCoarse:
      return "coarse";
    case AxesState::kRefined:
      return "refined";
  }
  throw std::invalid_argument("ToString: not an AxesState");
}

bool AxesEstimatorOptions::IsValid(std::string* error) const {
  if (!(coarse_sigma > 0.0)) {
    *error = "coarse_sigma must be positive (degrees)";
  } else if (min_keyframes < 1) {
    *error = "min_keyframes must be at least 1";
  } else if (min_axis_lines < 2) {
    *error = "min_axis_lines must be at least 2: one direction does not determine a rotation";
  } else if (!(min_growth > 1.0)) {
    *error = "min_growth must be larger than 1";
  } else if (!(min_line_ratio >= 0.0 && min_line_ratio <= 1.0)) {
    *error = "min_line_ratio must lie in [0, 1]";
  } else if (!(max_correction > 0.0)) {
    *error = "max_correction must be positive (degrees)";
  } else {
    return true;
  }
  return false;
}

AxesEstimator::AxesEstimator(const AxesEstimatorOptions& options) : options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("AxesEstimator: " + error);
}

void AxesEstimator::Propose(const Eigen::Quaterniond& world_from_axes) {
  if (state_ != AxesState::kNone) return;
  state_ = AxesState::kCoarse;
  world_from_axes_ = world_from_axes.normalized();
  sigma_ = DegreesToRadians(options_.coarse_sigma);
  num_axis_lines_tried_ = 0;
}

void AxesEstimator::Update(const AxesSupport& support) {
  support_ = support;
  const bool is_tested = support.num_keyframes >= options_.min_keyframes &&
                         support.num_lines >= options_.min_axis_lines;
  if (state_ == AxesState::kCoarse && is_tested &&
      support.num_axis_lines < options_.min_line_ratio * support.num_lines) {
    Drop();
  }
}

bool AxesEstimator::RefinementDue() const {
  return state_ != AxesState::kNone && support_.num_keyframes >= options_.min_keyframes &&
         support_.num_axis_lines >= options_.min_axis_lines &&
         support_.num_axis_lines >= options_.min_growth * num_axis_lines_tried_;
}

bool AxesEstimator::Refine(const Eigen::Quaterniond& world_from_axes,
                           const Eigen::Matrix3d& covariance) {
  if (!RefinementDue()) throw std::invalid_argument("AxesEstimator::Refine: none was due");
  const double correction = world_from_axes_.angularDistance(world_from_axes.normalized());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  const double sigma = std::sqrt(eigen.eigenvalues().z());
  const double max_correction = DegreesToRadians(options_.max_correction);
  // The negation also rejects NaN.
  if (!(correction <= max_correction && sigma <= max_correction)) {
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

void AxesEstimator::Drop() {
  state_ = AxesState::kNone;
  world_from_axes_ = Eigen::Quaterniond::Identity();
  sigma_ = 0.0;
  num_axis_lines_tried_ = 0;
}

}  // namespace msc_vo
