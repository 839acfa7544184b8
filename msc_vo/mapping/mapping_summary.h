// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/map/inactive_maps.h"
#include "msc_vo/mapping/loop_closer.h"
#include "msc_vo/mapping/map_joiner.h"
#include "msc_vo/mapping/submap.h"
#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/structure/axes_estimator.h"

namespace msc_vo {

/// Time of each stage of one keyframe step, milliseconds.
struct MappingTimes {
  double structure = 0.0;  ///< refinement of the keyframe's lines
  double creation = 0.0;   ///< insertion of the keyframe, landmark culling and creation
  double fusion = 0.0;
  double loop = 0.0;  ///< verification and correction of a loop
  double axes = 0.0;
  std::optional<double> window;  ///< local bundle adjustment; none if it was not due
  double readout = 0.0;          ///< estimation of the readout time
  double calibration = 0.0;      ///< estimation of the calibration
  double culling = 0.0;          ///< keyframe culling
};

/// A corrected calibration that the maps were brought up to date with.
struct CalibrationChange {
  CorrectionEstimate estimate;
  InactiveMaps maps_before;  ///< all maps, with the old poses
};

/// Result of one keyframe step.
struct MappingSummary {
  KeyframeId keyframe = kNoId;
  SubMapId submap = kNoSubMap;  ///< that the keyframe was inserted into
  int num_culled_keyframes = 0;
  std::optional<BundleAdjustmentSummary> window;  ///< none if no bundle adjustment was due
  AxesState axes_state = AxesState::kNone;        ///< after the step
  int num_axes_refinements = 0;                   ///< in the run so far
  std::optional<MapJoin> join;      ///< the submap was joined with that of an older segment
  int num_refused_joins = 0;        ///< in the run so far (MapJoiner::num_refused)
  std::optional<LoopClosure> loop;  ///< that was closed
  int num_refused_loops = 0;        ///< in the run so far (LoopCloser::num_refused)
  std::shared_ptr<const CalibrationChange> calibration;  ///< null: it was not changed
  MappingTimes times;
};

}  // namespace msc_vo
