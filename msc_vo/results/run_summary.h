// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/report/frame_view.h"
#include "msc_vo/report/report_statistics.h"

namespace msc_vo {

/// Where a run was found in the map of earlier sessions.
struct Localization {
  int frame = 0;         ///< index of the first frame in that world (FirstLocalizedFrame())
  double seconds = 0.0;  ///< since the first frame
  double length = 0.0;   ///< path of the camera so far by odometry, metres
};

/// Statistics of a run.
struct RunSummary {
  int num_frames = 0;
  std::array<int, 6> status_counts = {};  ///< by TrackingStatus
  int num_estimated = 0;                  ///< frames with an estimated pose: tracked or weak
  double tracked_ratio = 0.0;             ///< num_estimated / num_frames, 0..1
  /// Number of predicted and lost frames by LossCause.
  std::array<int, kNumLossCauses> loss_causes = {};
  std::vector<NotTrackedSpan> not_tracked;
  int num_frames_with_dynamic_objects = 0;
  /// Stages of tracking, "tracking" as a whole, stages of mapping, "mapping" as a whole.
  std::vector<StageTimeStatistics> stages;
  std::vector<Segment> segments;             ///< in order of time
  std::vector<Loop> loops;                   ///< in order of time
  bool has_earlier_sessions = false;         ///< began with the map of earlier sessions
  std::optional<Localization> localization;  ///< nullopt: the run was not found in that map
  int map_world = 0;                         ///< the world (Segment::world) of the map
  int num_keyframes = 0;
  int num_points = 0;
  int num_lines = 0;
  int num_planes = 0;
  std::array<int, 3> num_axis_lines = {0, 0, 0};  ///< map lines parallel to each Manhattan axis
  MapAxes axes;
  NoiseScale noise_scale;          ///< estimated scale of the sigmas of features
  double readout_time = 0.0;       ///< of the rolling shutter, seconds, given or self-calibrated
  CorrectionEstimate calibration;  ///< self-calibration
  CameraIntrinsics intrinsics;     ///< at the end of the run: as given, or corrected
  DepthCamera depth_camera;        ///< as in OdometryResult
  DepthSensor depth_sensor = DepthSensor::kAuto;  ///< given or chosen; kAuto: too little depth
  BundleAdjustmentSummary last_local_ba;

  /// Number of frames with the status.
  int Count(TrackingStatus status) const { return status_counts[static_cast<size_t>(status)]; }
};

RunSummary Summarize(const OdometryResult& result);

/// A run has failed if the ratio of estimated poses (tracked or weak) to processed images is
/// smaller.
constexpr double kMinTrackedRatio = 0.5;

/// Whether the run has failed by kMinTrackedRatio, or has no estimated pose at all.
bool TrackingFailed(const RunSummary& summary);

/// Causes of frames without an estimated pose and their numbers, in the order of LossCause: "12
/// black or uniform images, ...". Empty if all frames have an estimated pose.
std::string DescribeLosses(const RunSummary& summary);

/// The number of loops and the largest correction, one line.
std::string DescribeLoops(const RunSummary& summary);
/// The frames that closed loops, one line.
std::string DescribeLoopFrames(const RunSummary& summary);
/// When and where the run was found in the map of earlier sessions, one line.
std::string DescribeLocalization(const RunSummary& summary);
/// The number of segments, how many are joined, and how many are not in the map, one line.
std::string DescribeSegments(const RunSummary& summary);

/// Message of a run that failed, one line: number of estimated poses, causes of the missing ones.
std::string DescribeFailure(const RunSummary& summary);

/// The statistics of a stage; zero if it never ran.
StageTimeStatistics FindStage(const RunSummary& summary, const std::string& name);

/// Computing resources that a run used.
struct RunCost {
  double seconds = 0.0;            ///< wall time from the first image to the last pose
  double processor_seconds = 0.0;  ///< user and system time, summed over all threads
  double peak_memory = 0.0;        ///< resident, MiB
};

/// Latency of a replay in real time.
struct RealtimeSummary {
  /// Milliseconds from the time at which an image is due to its pose, over all images that were not
  /// dropped.
  StageTimeStatistics pose_age;
  /// Maps that were not ready when they were due. If it is 0 and no image was dropped, the results
  /// equal those of a replay without real time.
  int num_late_maps = 0;
};

/// Inputs and circumstances of a run, which its result does not contain.
struct RunContext {
  std::string command_line;
  /// "complete", "interrupted", the reason of failed tracking, or the error that ended the run.
  std::string outcome;
  std::string sequence_name;  ///< title of the report
  SequenceIndex sequence;
  Calibration calibration;
  Configuration configuration;
  /// Error message of the first unreadable image, which names the file; empty without one.
  std::string first_unreadable;
  std::optional<TrajectoryError> error;      ///< nullopt without ground truth
  std::vector<SegmentError> segment_errors;  ///< empty without ground truth or with one segment
  RunCost cost;
  std::optional<RealtimeSummary> realtime;  ///< nullopt unless the run was in real time
  std::vector<FrameView> views;    ///< for the report, with the ids of frames; may be empty
  std::optional<PlaceView> place;  ///< for the report, with the id of the frame
};

/// Camera poses of all frames. Frames that are neither tracked nor weak are marked as not
/// estimated; those before the first segment have the pose of its first frame.
std::vector<TimedPose> TrajectoryOf(const OdometryResult& result);

}  // namespace msc_vo
