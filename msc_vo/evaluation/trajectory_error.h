// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/evaluation/error_statistics.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

struct EvaluationOptions {
  double max_time_difference = 0.02;  // seconds, between an estimate and its reference pose
  double rpe_seconds = 1.0;           // time over which the first relative error is taken
  double rpe_metres = 1.0;            // length of path over which the second one is taken
  // Poses that are not estimated (TimedPose) are compared too; by default they do not exist.
  bool all_poses = false;

  bool IsValid(std::string* error) const;
};

// Error of one pose after alignment.
struct PoseError {
  double timestamp = 0.0;    // seconds, of the estimate
  double translation = 0.0;  // metres
  double rotation = 0.0;     // radians
};

// A difference of motion over a stretch of the trajectory.
struct RelativeError {
  ErrorStatistics translation;  // metres
  ErrorStatistics rotation;     // radians
};

// How well a trajectory agrees with a reference. Never read the errors without the coverage: a
// trajectory that stops early has an easy life.
struct TrajectoryError {
  bool usable = false;  // false: `message` says why there are no numbers
  std::string message;

  int num_reference = 0;
  int num_estimate = 0;       // poses that are compared
  int num_not_estimated = 0;  // poses that are left out, see EvaluationOptions::all_poses
  int num_matched = 0;
  int num_reference_in_range = 0;  // between the first and the last stamp of the estimate
  double coverage = 0.0;           // matched / reference, 0..1
  double coverage_in_range = 0.0;  // matched / reference in range
  double path_length = 0.0;        // metres, along the matched reference poses

  Rigid3 reference_from_estimate;  // the alignment, world to world, no scale
  ErrorStatistics ape;             // metres, positions after alignment
  // Radians. `rotation` is that of orientations after their own alignment, by the rotation of
  // AlignOrientations(); `ape_rotation` that after the alignment of positions, which a short or
  // straight path hardly determines: there it says nothing of the estimate.
  ErrorStatistics rotation;
  ErrorStatistics ape_rotation;
  RelativeError rpe_per_second;     // over pairs `rpe_seconds` apart
  RelativeError rpe_per_metre;      // over pairs `rpe_metres` apart, divided by their distance
  std::vector<PoseError> per_pose;  // of the matched poses, in order of time
};

// Compares an estimate with a reference: nearest stamps one to one, rigid alignment (Umeyama), then
// APE |q_i - (R p_i + t)| and RPE |(Q_i^-1 Q_j)^-1 (P_i^-1 P_j)|, with (P, p) the estimate and (Q,
// q) the reference. The inputs may come in any order of time. Fewer than three matches are not an
// error of the caller: `usable` is false then. Throws std::invalid_argument on options that are not
// valid.
TrajectoryError EvaluateTrajectory(const std::vector<TimedPose>& reference,
                                   const std::vector<TimedPose>& estimate,
                                   const EvaluationOptions& options = {});

// The alignment for what was mapped along the way: the mean of the differences of orientation (the
// rotation with the least sum of squares of R Q_estimate - Q_reference), and the mean positions
// upon each other. Positions alone hardly tell how a nearly straight way is turned about itself, by
// which every line beside it would be. std::nullopt without a match.
std::optional<Rigid3> AlignOrientations(const std::vector<TimedPose>& reference,
                                        const std::vector<TimedPose>& estimate,
                                        const EvaluationOptions& options = {});

// The estimate expressed in the world of the reference.
std::vector<TimedPose> Transformed(const Rigid3& reference_from_estimate,
                                   std::vector<TimedPose> estimate);

}  // namespace msc_vo
