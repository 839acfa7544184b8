// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

enum class AxesState {
  kNone,     // no axes: every keyframe is asked for coarse ones
  kCoarse,   // from one keyframe
  kRefined,  // from the lines of many keyframes
};

// "none", "coarse", "refined".
const char* ToString(AxesState state);

struct AxesEstimatorOptions {
  // Of coarse axes about each direction, radians. Their error is 0.1 degrees in rendered rooms, 1
  // to 1.5 with a real sensor, which bends surfaces.
  double coarse_sigma = DegreesToRadians(1.0);
  // A line wants several views before its direction is its own and not that of one view's noise.
  int min_keyframes = 5;
  // Lines on axes: three unknowns, and a robust loss needs many more equations than unknowns.
  int min_axis_lines = 20;
  // Refined anew when so many times the lines of the last time are on axes: a fifth less sigma.
  double min_growth = 1.5;
  // Coarse axes are dropped when fewer of the map's lines keep to them than this: they fitted one
  // keyframe, not the scene. Half of what the keyframe must show.
  double min_line_ratio = 0.25;
  // A refinement that turns the axes farther contradicts what it started from, radians: three
  // sigmas of coarse axes with a real sensor.
  double max_correction = DegreesToRadians(4.0);
  // Axes as certain as this, which the last refinement did not turn by more than three times as
  // much, stay as they are, radians. Their error is below 0.3 degrees then.
  double freeze_sigma = DegreesToRadians(0.1);

  bool IsValid(std::string* error) const;
};

// What the map holds, counted by the caller after each keyframe.
struct AxesSupport {
  int num_keyframes = 0;
  int num_lines = 0;       // with a direction certain enough to be assigned to an axis or to none
  int num_axis_lines = 0;  // of these, on an axis
};

// Owns the Manhattan axes of the world from the first guess to the last digit (paper: Manhattan
// Axes Estimation, coarse to fine): none -> coarse -> refined, then refined again as the map grows,
// until frozen; and back to none if coarse axes prove wrong. Computes no axes itself:
//
//   if (estimator.state() == AxesState::kNone) Propose() what FindCoarseAxes() finds, in the world
//   Update() with what the map holds
//   if (estimator.RefinementDue()) solve for the axes, then Refine() or RejectRefinement()
class AxesEstimator {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit AxesEstimator(const AxesEstimatorOptions& options);

  // Takes coarse axes, in the world; without effect unless there are none yet.
  void Propose(const Eigen::Quaterniond& world_from_axes);
  void Update(const AxesSupport& support);
  bool RefinementDue() const;
  // Takes refined axes and the covariance (radians^2) of their rotation vector, of which only the
  // largest eigenvalue counts. Returns false, with the effect of RejectRefinement(), if they
  // contradict the axes so far. Throws std::invalid_argument if no refinement was due.
  bool Refine(const Eigen::Quaterniond& world_from_axes, const Eigen::Matrix3d& covariance);
  // The axes could not be refined: coarse ones are dropped, refined ones kept; the next try waits
  // until the map has grown. Throws std::invalid_argument if no refinement was due.
  void RejectRefinement();

  AxesState state() const { return state_; }
  bool frozen() const { return frozen_; }
  int num_refinements() const { return num_refinements_; }
  // Columns of its matrix: the axes in the world. Meaningless without axes.
  const Eigen::Quaterniond& world_from_axes() const { return world_from_axes_; }
  double sigma() const { return sigma_; }  // radians, of the least certain direction

 private:
  void Drop();

  AxesEstimatorOptions options_;
  AxesState state_ = AxesState::kNone;
  bool frozen_ = false;
  int num_refinements_ = 0;
  Eigen::Quaterniond world_from_axes_ = Eigen::Quaterniond::Identity();
  double sigma_ = 0.0;
  AxesSupport support_;
  int num_axis_lines_tried_ = 0;  // at the last refinement, whether taken or not
};

}  // namespace msc_vo
