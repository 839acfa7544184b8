// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

enum class AxesState {
  kNone,     ///< no axes: coarse axes are searched for in every keyframe
  kCoarse,   ///< estimated from one keyframe
  kRefined,  ///< estimated from the lines of many keyframes
};

/// "none", "coarse", "refined".
const char* ToString(AxesState state);

/// Support of the axes in the map, counted by the caller after each keyframe.
struct AxesSupport {
  int num_keyframes = 0;
  int num_lines = 0;       ///< with a direction that is certain enough for an association
  int num_axis_lines = 0;  ///< of these, associated with an axis
};

/// State machine of the Manhattan axes of the world (paper: Manhattan Axes Estimation, coarse to
/// fine): none -> coarse -> refined, refined again as the map grows; back to none if coarse axes
/// prove wrong. The caller computes the axes:
///
///   if (estimator.state() == AxesState::kNone) Propose() the result of FindCoarseAxes()
///   Update() with the support in the map
///   if (estimator.RefinementDue()) RefineManhattanAxes(), then Refine() or RejectRefinement()
class AxesEstimator {
 public:
  /// Standard deviation of coarse axes about each direction, radians. Measured errors are 0.1
  /// degrees in rendered rooms and 1 to 1.5 degrees with a structured-light sensor, which bends
  /// surfaces.
  static constexpr double kCoarseSigma = DegreesToRadians(1.0);

  /// Sets coarse axes; no effect unless the state is kNone.
  void Propose(const Eigen::Quaterniond& world_from_axes);
  /// Sets the support of the axes in the map. Drops coarse axes with too few lines on them.
  void Update(const AxesSupport& support);
  /// Whether the map holds enough keyframes and lines, and enough more lines than at the last
  /// refinement.
  bool RefinementDue() const;
  /// Sets refined axes with the covariance (radians^2) of their rotation vector, of which the
  /// largest eigenvalue is used. Returns false, with the effect of RejectRefinement(), if they
  /// contradict the axes so far. Throws std::invalid_argument if no refinement was due.
  bool Refine(const Eigen::Quaterniond& world_from_axes, const Eigen::Matrix3d& covariance);
  /// Reports a failed refinement: coarse axes are dropped, refined ones are kept, and the next
  /// refinement is due when the map has grown. Throws std::invalid_argument if none was due.
  void RejectRefinement();

  /// Sets axes of an earlier run, with their sigma (radians).
  void Restore(const Eigen::Quaterniond& world_from_axes, double sigma);

  AxesState state() const { return state_; }
  int num_refinements() const { return num_refinements_; }
  /// The columns of its matrix are the axes in the world. Meaningless in state kNone.
  const Eigen::Quaterniond& world_from_axes() const { return world_from_axes_; }
  double sigma() const { return sigma_; }  ///< radians, of the least certain direction

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [axes_state, refinements, rotation, rotation_sigma, support,
           num_axis_lines_tried] = *this;  // all members, or it does not compile
    archive(axes_state, refinements, rotation, rotation_sigma, support, num_axis_lines_tried);
  }

 private:
  void Drop();

  AxesState state_ = AxesState::kNone;
  int num_refinements_ = 0;
  Eigen::Quaterniond world_from_axes_ = Eigen::Quaterniond::Identity();
  double sigma_ = 0.0;
  AxesSupport support_;
  int num_axis_lines_tried_ = 0;  // at the last refinement, accepted or not
};

}  // namespace msc_vo
