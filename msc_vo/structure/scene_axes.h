// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/structure/axes_estimator.h"
#include "msc_vo/structure/axes_refinement.h"
#include "msc_vo/structure/axis_association.h"
#include "msc_vo/structure/axis_evidence.h"
#include "msc_vo/structure/coarse_axes.h"

namespace msc_vo {

struct SceneAxesOptions {
  bool enabled = true;
  CoarseAxesOptions coarse;
  AxisAssociationOptions association;
  ManhattanAxesOptions refinement;
  AxesEstimatorOptions estimator;
  /// Standard deviation of the direction of a built line from its axis, degrees; as
  /// FrameStructureOptions::pair_sigma.
  double deviation = 0.7;

  bool IsValid(std::string* error) const;
};

/// Index 0..2 of the axis that a map line is parallel to; std::nullopt if there is none.
std::optional<int> AxisOfLine(const SceneAxesOptions& options, const AxesEstimate& axes,
                              const LineLandmark& line);

/// The Manhattan axes of the map (paper: Manhattan Axes Estimation and Association): found in one
/// keyframe, refined over the lines of all keyframes, and associated with the lines of a window.
class SceneAxes {
 public:
  /// Throws std::invalid_argument on options that are not valid.
  explicit SceneAxes(const SceneAxesOptions& options);

  /// Call after `keyframe` was added to the map. `normals`: its surface normals, camera frame;
  /// needed only while there are no axes.
  void Update(const Map& map, KeyframeId keyframe, const std::vector<AxisEvidence>& normals);

  /// Index 0..2 of the axis that the line is parallel to; std::nullopt if there is none.
  std::optional<int> AxisOf(const LineLandmark& line) const;
  /// Adds alignments of the window's lines with their axes (paper: M_j).
  void AddAlignments(const Map& map, WindowData* window) const;

  const AxesEstimator& estimator() const { return estimator_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, axes_estimator] = *this;  // all members, or it does not compile
    archive(axes_estimator);
  }

 private:
  void Search(const Map& map, KeyframeId keyframe, const std::vector<AxisEvidence>& normals);
  AxesSupport CountSupport(const Map& map) const;
  void Refine(const Map& map);

  SceneAxesOptions options_;
  AxesEstimator estimator_;
};

}  // namespace msc_vo
