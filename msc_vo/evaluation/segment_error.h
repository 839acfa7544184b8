// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Errors of one segment of a trajectory, with an alignment of its own.
struct SegmentError {
  int segment = 0;
  int world = 0;
  TrajectoryError error;
};

/// Compares each segment (TimedPose::segment) with the reference by itself, in order of their
/// numbers. Empty if there is only one, whose error is that of the whole trajectory.
std::vector<SegmentError> EvaluateSegments(const std::vector<TimedPose>& reference,
                                           const std::vector<TimedPose>& estimate,
                                           const EvaluationOptions& options = {});

/// Whether the poses are in worlds with an unknown transform between them.
bool HasSeveralWorlds(const std::vector<TimedPose>& poses);

}  // namespace msc_vo
