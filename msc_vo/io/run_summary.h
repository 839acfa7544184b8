// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/io/calibration.h"
#include "msc_vo/io/option_list.h"
#include "msc_vo/io/sequence.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

// Milliseconds of one stage over the frames that ran it.
struct StageStatistics {
  std::string name;
  int count = 0;  // frames; for "mapping" those that caused a keyframe step
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;  // 95 % of the frames took no longer
  double max = 0.0;
};

// Frames in a row that have no estimated pose (predicted or lost).
struct UntrackedSpan {
  int first = 0;  // positions in the run
  int last = 0;
  double start = 0.0;  // seconds, stamps of the two
  double end = 0.0;
};

// A run in numbers.
struct RunSummary {
  int num_frames = 0;
  std::array<int, 4> status_counts = {0, 0, 0, 0};  // by TrackingStatus
  double tracked_share = 0.0;                       // tracked or weak / all, 0..1
  std::vector<UntrackedSpan> untracked;
  std::vector<StageStatistics> stages;  // in order of time; "tracking" is their sum
  int num_keyframes = 0;
  int num_points = 0;
  int num_lines = 0;
};

RunSummary Summarize(const OdometryResult& result);

// What only the one who made the run knows.
struct RunContext {
  std::string command_line;
  std::string outcome;  // "complete", "interrupted", or the error that ended the run
  SequenceIndex sequence;
  Calibration calibration;
  Configuration configuration;
  std::optional<TrajectoryError> error;  // against the ground truth, if there is one
  double seconds = 0.0;                  // wall time from the first image to the last pose
  double peak_memory = 0.0;              // resident, MiB
};

// The contents of summary.json.
std::string FormatSummary(const RunSummary& summary, const RunContext& context);

// The numbers of a comparison as JSON: metres, degrees, seconds.
std::string FormatErrorJson(const TrajectoryError& error);

// The poses of all frames, camera in world.
std::vector<TimedPose> TrajectoryOf(const OdometryResult& result);

}  // namespace msc_vo
