// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>

#include "msc_vo/map/noise_scale.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/mapping_runner.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/sensor/depth_limits.h"
#include "msc_vo/structure/axes_estimator.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Writes the events of a run to the logger of the library. Events are changes, so a long run of
/// lost frames is one line. Lines come in the same order in every run.
class EventLog {
 public:
  /// Configuration of the run. Call first.
  void LogStart(const OdometryOptions& options, const PinholeCamera& camera);
  /// The depth sensor, once it is known.
  void LogDepthSensor(DepthSensor sensor);
  /// Depths at which the images are clipped, found with image `id`.
  static void LogClippedDepth(int64_t id, const DepthLimits& limits);
  /// Changes of the tracking status, and keyframes. `relocalized`: the pose was found without a
  /// prediction.
  void LogFrame(const FrameResult& frame, bool relocalized);
  /// The next frame begins a segment. The first one is not logged.
  void LogSegment(int segment, SegmentStart start);
  /// Changes of the Manhattan axes and of the readout time, loops, joins of maps, and refused ones.
  void LogMapping(const MappingStep& step);
  /// Self-calibration at the end of the run; `readout_time` in seconds.
  void LogFinish(const NoiseScale& noise_scale, double readout_time, int num_frames) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [status, status_since, axes_state, num_axes_refinements, readout_time, last_moved_map,
           num_refused_joins, num_refused_loops, depth_sensor, chooses_depth_sensor] =
        *this;  // all members, or it does not compile
    archive(status, status_since, axes_state, num_axes_refinements, readout_time, last_moved_map,
            num_refused_joins, num_refused_loops, depth_sensor, chooses_depth_sensor);
  }

 private:
  static void LogCalibration(const MappingStep& step);
  static void LogLoop(const LoopClosure& loop);
  void LogStatus(const FrameResult& frame, bool relocalized);

  std::optional<TrackingStatus> status_;  // of the last frame
  int64_t status_since_ = 0;              // id of the first frame with that status
  AxesState axes_state_ = AxesState::kNone;
  int num_axes_refinements_ = 0;
  double readout_time_ = 0.0;            // seconds
  SubMapId last_moved_map_ = kNoSubMap;  // of the last join
  int num_refused_joins_ = 0;
  int num_refused_loops_ = 0;
  DepthSensor depth_sensor_ = DepthSensor::kAuto;
  bool chooses_depth_sensor_ = true;
};

}  // namespace msc_vo
