// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/plane.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/structure/axes_estimator.h"
#include "msc_vo/structure/axes_refinement.h"
#include "msc_vo/structure/axis_association.h"
#include "msc_vo/structure/axis_evidence.h"
#include "msc_vo/structure/coarse_axes.h"
#include "msc_vo/structure/deviation_estimator.h"
#include "msc_vo/structure/direction_estimate.h"

namespace msc_vo {

struct SceneAxesOptions {
  bool enabled = true;
};

/// Index 0..2 of the axis that a map line is parallel to; std::nullopt if there is none.
std::optional<int> AxisOfLine(const AxesEstimate& axes, const LineLandmark& line);

/// Index 0..2 of the axis that the normal of a map plane is parallel to, within kMaxAxisAngle;
/// std::nullopt if there is none.
std::optional<int> AxisOfPlane(const AxesEstimate& axes, const Plane& plane);

/// The Manhattan axes of the map (paper: Manhattan Axes Estimation and Association): found in one
/// keyframe, refined over the lines of all windows, and associated with the lines of a window.
class SceneAxes {
 public:
  explicit SceneAxes(const SceneAxesOptions& options) : options_(options) {}

  /// Begins with the axes of an earlier run. If axes are disabled, they are kept for Saved() only.
  /// The deviation of lines is learnt again.
  void Restore(const AxesEstimate& axes);
  /// Forgets what this run has estimated.
  void Reset();
  /// Call after `keyframe` was added to the map. `normals`: its surface normals, camera frame;
  /// needed only while there are no axes.
  void Update(const Map& map, KeyframeId keyframe, const std::vector<AxisEvidence>& normals);
  /// Adds alignments of the window's lines with their axes (paper: M_j), once the axes are refined:
  /// the error of coarse axes is common to all lines, and each would count it as its own.
  void AddAlignments(WindowData* window) const { AddAlignments(kMaxAxisAngle, window); }
  /// The same, and for uncertain lines as well: for a window in which no pose depends on them. They
  /// gain most from an axis, but each of them that follows none would turn the camera.
  void AddAllAlignments(WindowData* window) const;
  /// Takes over the directions of the lines of an optimised window, from which the axes and the
  /// deviation of the lines are estimated.
  void Learn(const Map& map, const WindowData& window);

  /// Index 0..2 of the axis that the line is parallel to; std::nullopt if there is none.
  std::optional<int> AxisOf(const LineLandmark& line) const;
  /// The axes; std::nullopt until they are found.
  std::optional<AxesEstimate> Estimate() const;
  /// The axes for later runs: those of the earlier run until this one has estimated directions.
  std::optional<AxesEstimate> Saved() const {
    return directions_.empty() && restored_ ? restored_ : Estimate();
  }
  const AxesEstimator& estimator() const { return estimator_; }
  const DeviationEstimator& deviation() const { return deviation_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, restored, axes_estimator, deviation, directions] = *this;  // all members
    archive(restored, axes_estimator, deviation, directions);
  }

 private:
  void Search(const Map& map, KeyframeId keyframe, const std::vector<AxisEvidence>& normals);
  std::optional<AxisCandidate> NearestAxis(const DirectionEstimate& line) const;
  void AddAlignments(double max_angle, WindowData* window) const;
  AxesSupport CountSupport(const Map& map) const;
  void Refine();

  SceneAxesOptions options_;
  std::optional<AxesEstimate> restored_;  // of an earlier run
  AxesEstimator estimator_;
  DeviationEstimator deviation_;
  std::map<LandmarkId, DirectionEstimate> directions_;  // as the last window of each line had them
};

}  // namespace msc_vo
