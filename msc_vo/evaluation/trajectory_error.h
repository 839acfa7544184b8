// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/evaluation/error_statistics.h"
#include "msc_vo/evaluation/relative_pairs.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Alignment of an estimate with its reference before absolute errors are measured.
enum class Alignment {
  kSe3,     ///< rigid: rotation and translation (Umeyama)
  kSim3,    ///< similarity: also a scale, for estimates without metric scale
  kOrigin,  ///< the first matched pose of both
  kNone,
};

/// "se3", "sim3", "origin", "none".
const char* ToString(Alignment alignment);
/// Parses these names. Throws std::invalid_argument, naming the choices, on any other name.
Alignment AlignmentFromString(const std::string& name);

struct EvaluationOptions {
  /// Largest difference of the stamps of an estimate and its reference pose, seconds: the default
  /// of the TUM RGB-D tools.
  double max_time_difference = 0.02;
  double rpe_seconds = 1.0;  ///< seconds, interval of the relative error per second
  double rpe_metres = 1.0;   ///< metres, path length of the relative error per metre
  Alignment alignment = Alignment::kSe3;
  RelativeDelta rpe_delta;  ///< of TrajectoryError::rpe
  /// Also compares poses that are marked as not estimated (TimedPose); by default they are ignored.
  bool all_poses = false;
  /// The estimate is a trajectory of msc_vo itself: warnings about the axes of the camera or the
  /// order of quaternions name the reference only.
  bool estimate_is_own = false;

  /// If an option is invalid, `error` names it and its valid range.
  bool IsValid(std::string* error) const;
};

/// Error of one pose after alignment.
struct PoseError {
  double timestamp = 0.0;    ///< seconds, of the estimate
  double translation = 0.0;  ///< metres
  double rotation = 0.0;     ///< radians
};

/// Relative pose error (RPE) over a fixed interval or path length.
struct RelativeError {
  ErrorStatistics translation;  ///< metres
  ErrorStatistics rotation;     ///< radians
};

/// Errors of a trajectory with respect to a reference. Read the errors together with the coverage:
/// a trajectory that stops early has small errors.
struct TrajectoryError {
  bool usable = false;  ///< false: there are no errors, `message` names the reason
  std::string message;
  /// What makes the errors doubtful although they are usable: an alignment that is not determined,
  /// scales or orientations that contradict each other (alignment_check.h), few partners at common
  /// times.
  std::vector<std::string> warnings;

  int num_reference = 0;
  int num_estimate = 0;       ///< poses that are compared
  int num_not_estimated = 0;  ///< poses that are ignored, see EvaluationOptions::all_poses
  int num_matched = 0;
  int num_reference_in_range = 0;  ///< between the first and the last stamp of the estimate
  double coverage = 0.0;           ///< matched / reference, 0..1
  double coverage_in_range = 0.0;  ///< matched / reference in range
  double path_length = 0.0;        ///< metres, along the matched reference poses

  Alignment alignment = Alignment::kSe3;
  /// The alignment, world to world: reference_from_estimate * (scale * position).
  Rigid3 reference_from_estimate;
  double scale = 1.0;   ///< of the estimate's positions; 1 unless the alignment is kSim3
  ErrorStatistics ape;  ///< metres, absolute pose error: positions after alignment
  /// Radians, orientations after their own alignment by AlignOrientations(); with kOrigin and kNone
  /// the same as `ape_rotation`.
  ErrorStatistics rotation;
  /// Radians, orientations after the alignment of positions. Not meaningful for short or straight
  /// paths, which hardly determine the rotation of that alignment.
  ErrorStatistics ape_rotation;
  RelativeError rpe;                ///< over the pairs of EvaluationOptions::rpe_delta
  RelativeError rpe_per_second;     ///< over pairs `rpe_seconds` apart
  RelativeError rpe_per_metre;      ///< over pairs `rpe_metres` apart, divided by their distance
  std::vector<PoseError> per_pose;  ///< of the matched poses, in order of time
  std::vector<TimedPose> matched_reference;  ///< the matched poses, in the same order
  std::vector<TimedPose> matched_estimate;   ///< the same, aligned
};

/// Compares an estimate with a reference: association by time (AssociateStamps), alignment, by
/// default rigid (Umeyama), then APE |q_i - (s R p_i + t)| and RPE |(Q_i^-1 Q_j)^-1 (P_i^-1 P_j)|,
/// where (P, p) is the estimate and (Q, q) the reference, both camera in world. The poses may be in
/// any order; poses of the same time are matched in their order. With fewer than three matches, or
/// if a scale is to be aligned to positions that are all the same, the result is not `usable`.
/// Throws std::invalid_argument on invalid options.
TrajectoryError EvaluateTrajectory(const std::vector<TimedPose>& reference,
                                   const std::vector<TimedPose>& estimate,
                                   const EvaluationOptions& options = {});

/// What to do about a result that is not usable: "--all-poses compares them" if poses were left
/// out, a question about the clock if few match. Empty for other causes. `all_poses`: the name
/// under which the user sets EvaluationOptions::all_poses.
std::string DescribeRemedy(const TrajectoryError& error, const std::string& all_poses);

/// Aligns orientations: the rotation minimises the sum of squares of R Q_estimate - Q_reference,
/// the translation aligns the mean positions. Suited for comparing maps: positions alone do not
/// determine the rotation about a nearly straight path, which would move every line beside it.
/// Returns std::nullopt if no poses match. Throws std::invalid_argument on invalid options.
std::optional<Rigid3> AlignOrientations(const std::vector<TimedPose>& reference,
                                        const std::vector<TimedPose>& estimate,
                                        const EvaluationOptions& options = {});

/// Transforms the poses of the estimate into the world of the reference; positions are scaled
/// first.
std::vector<TimedPose> Transformed(const Rigid3& reference_from_estimate,
                                   std::vector<TimedPose> estimate, double scale = 1.0);

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
