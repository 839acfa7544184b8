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
#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/report/report_statistics.h"

namespace msc_vo {

/// A run in numbers.
struct RunSummary {
  int num_frames = 0;
  std::array<int, 6> status_counts = {};  ///< by TrackingStatus
  int num_estimated = 0;                  ///< tracked or weak
  double tracked_share = 0.0;             ///< num_estimated / num_frames, 0..1
  /// Why predicted and lost frames have no pose of their own, by LossCause.
  std::array<int, kNumLossCauses> loss_causes = {};
  std::vector<NotTrackedSpan> not_tracked;
  int num_frames_with_motion = 0;  ///< in which something moved by itself
  /// Stages of tracking, "tracking" as a whole, stages of mapping, "mapping" as a whole.
  std::vector<StageTimeStatistics> stages;
  int num_keyframes = 0;
  int num_points = 0;
  int num_lines = 0;
  std::array<int, 3> num_axis_lines = {0, 0, 0};  ///< lines parallel to each Manhattan axis
  MapAxes axes;
  NoiseScale noise_scale;     ///< of the sigmas of features, as learnt
  double readout_time = 0.0;  ///< of a rolling shutter, seconds, as known or learnt
  BundleAdjustmentSummary last_window;

  /// Number of frames with the status.
  int Count(TrackingStatus status) const { return status_counts[static_cast<size_t>(status)]; }
};

RunSummary Summarize(const OdometryResult& result);

/// A run with a smaller share of estimated poses (tracked or weak) among the images that were not
/// dropped has failed: what it found is not the trajectory of the camera.
constexpr double kMinTrackedShare = 0.5;

bool TrackingFailed(const RunSummary& summary);

/// Why frames have no estimated pose, most basic cause first: "12 black or uniform images, ...".
/// Empty if all frames have one.
std::string DescribeLosses(const RunSummary& summary);

/// One line for a run that failed: how many poses there are, and why the others are missing.
std::string DescribeFailure(const RunSummary& summary);

/// The statistics of a stage; all zero if it never ran.
StageTimeStatistics FindStage(const RunSummary& summary, const std::string& name);

/// What a run took from the machine.
struct RunCost {
  double seconds = 0.0;            ///< wall time from the first image to the last pose
  double processor_seconds = 0.0;  ///< of all threads, in user and in system mode
  double peak_memory = 0.0;        ///< resident, MiB
};

/// How a replay in real time kept pace with the time stamps.
struct RealtimeSummary {
  /// Milliseconds from the moment that an image appears to its pose, over the images that were not
  /// dropped.
  StageTimeStatistics pose_age;
  int num_late_maps = 0;  ///< 0, and no image dropped: the run as it is without real time
};

/// What only the one who made the run knows.
struct RunContext {
  std::string command_line;
  /// "complete", "interrupted", why tracking failed, or the error that ended the run.
  std::string outcome;
  SequenceIndex sequence;
  Calibration calibration;
  Configuration configuration;
  /// Why the first image with status unreadable could not be read, with the name of its file;
  /// empty: there is none.
  std::string first_unreadable;
  std::optional<TrajectoryError> error;  ///< against the ground truth, if there is one
  RunCost cost;
  std::optional<RealtimeSummary> realtime;  ///< none: as fast as possible
};

/// The contents of summary.json.
std::string FormatSummary(const RunSummary& summary, const RunContext& context);

/// Rows of two trajectory files that are no poses (nan, inf).
struct LeftOutRows {
  int reference = 0;
  int estimate = 0;
};

/// The numbers of a comparison as JSON: metres, degrees, seconds. Those of the lines are the object
/// "lines", which is missing if they were not compared.
std::string FormatErrorJson(const TrajectoryError& error, const LeftOutRows& left_out,
                            const std::optional<LineError>& lines = std::nullopt);

/// The poses of all frames, camera in world; those of frames that are neither tracked nor weak are
/// marked as not estimated.
std::vector<TimedPose> TrajectoryOf(const OdometryResult& result);

}  // namespace msc_vo
