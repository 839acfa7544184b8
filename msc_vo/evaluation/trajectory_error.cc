// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/trajectory_error.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "msc_vo/evaluation/alignment_check.h"
#include "msc_vo/evaluation/association.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/geometry/rigid_alignment.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/text/enum_names.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMinMatches = 3;

// Matched poses of reference and estimate, both camera in world.
struct PosePair {
  TimedPose reference;
  TimedPose estimate;
};

std::vector<TimedPose> SortedByTime(std::vector<TimedPose> poses) {
  SortByTime(&poses);
  return poses;
}

// Selects the poses to be compared, in order of time.
std::vector<TimedPose> SelectCompared(std::vector<TimedPose> estimate,
                                      const EvaluationOptions& options) {
  if (!options.all_poses) {
    EraseIf(&estimate, [](const TimedPose& pose) { return !pose.is_estimated; });
  }
  return SortedByTime(std::move(estimate));
}

// Matches poses by time; both trajectories must be in order of time.
std::vector<PosePair> MatchPoses(const std::vector<TimedPose>& reference,
                                 const std::vector<TimedPose>& estimate,
                                 double max_time_difference) {
  std::vector<PosePair> pairs;
  for (const StampMatch& match :
       AssociateStamps(TimestampsOf(reference, &TimedPose::timestamp),
                       TimestampsOf(estimate, &TimedPose::timestamp), max_time_difference)) {
    pairs.push_back({reference[match.reference], estimate[match.query]});
  }
  return pairs;
}

double AngleOf(const Eigen::Quaterniond& rotation) { return LogSO3(rotation).norm(); }

// (Q_i^-1 Q_j)^-1 (P_i^-1 P_j)
Rigid3 RelativeMotionError(const PosePair& from, const PosePair& to) {
  const Rigid3 reference = from.reference.world_from_cam.Inverse() * to.reference.world_from_cam;
  const Rigid3 estimate = from.estimate.world_from_cam.Inverse() * to.estimate.world_from_cam;
  return reference.Inverse() * estimate;
}

std::vector<Eigen::Vector3d> Positions(const std::vector<PosePair>& pairs,
                                       TimedPose PosePair::*which) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    positions.emplace_back((pair.*which).world_from_cam.translation());
  }
  return positions;
}

// The scale of the estimate; 1 unless it is to be aligned.
double ScaleOf(const std::vector<PosePair>& pairs, Alignment alignment) {
  if (alignment != Alignment::kSim3) return 1.0;
  return AlignmentScale(Positions(pairs, &PosePair::estimate),
                        Positions(pairs, &PosePair::reference));
}

// The rigid part of the alignment; the estimate of the pairs is already scaled.
Rigid3 AlignPairs(const std::vector<PosePair>& pairs, Alignment alignment) {
  switch (alignment) {
    case Alignment::kSe3:
    case Alignment::kSim3:
      return AlignRigid(Positions(pairs, &PosePair::estimate),
                        Positions(pairs, &PosePair::reference));
    case Alignment::kOrigin:
      return pairs.front().reference.world_from_cam *
             pairs.front().estimate.world_from_cam.Inverse();
    case Alignment::kNone:
      break;
  }
  return {};
}

// Computes the alignment and the absolute errors after it.
void MeasureAbsolute(const std::vector<PosePair>& pairs, TrajectoryError* error) {
  error->reference_from_estimate = AlignPairs(pairs, error->alignment);
  std::vector<double> translations, rotations;
  for (const PosePair& pair : pairs) {
    const Rigid3 aligned = error->reference_from_estimate * pair.estimate.world_from_cam;
    const Rigid3& truth = pair.reference.world_from_cam;
    translations.push_back((aligned.translation() - truth.translation()).norm());
    rotations.push_back(AngleOf(truth.rotation().conjugate() * aligned.rotation()));
    error->per_pose.push_back({pair.estimate.timestamp, translations.back(), rotations.back()});
    error->matched_reference.push_back(pair.reference);
    error->matched_estimate.push_back({pair.estimate.timestamp, aligned});
  }
  error->ape = StatisticsOf(translations);
  error->ape_rotation = StatisticsOf(rotations);
}

// Aligns orientations and mean positions.
Rigid3 AlignByOrientation(const std::vector<PosePair>& pairs) {
  std::vector<Rigid3> source, target;
  for (const PosePair& pair : pairs) {
    source.push_back(pair.estimate.world_from_cam);
    target.push_back(pair.reference.world_from_cam);
  }
  return AlignPoses(source, target);
}

ErrorStatistics MeasureRotation(const std::vector<PosePair>& pairs) {
  const Eigen::Quaterniond reference_from_estimate(AlignByOrientation(pairs).rotation());
  std::vector<double> angles;
  for (const PosePair& pair : pairs) {
    angles.push_back(AngleOf(pair.reference.world_from_cam.rotation().conjugate() *
                             reference_from_estimate * pair.estimate.world_from_cam.rotation()));
  }
  return StatisticsOf(angles);
}

// Relative error over pairs of poses.
RelativeError MeasureRelative(const std::vector<PosePair>& pairs,
                              const std::vector<std::pair<int, int>>& ends) {
  std::vector<double> translations, rotations;
  for (const auto& [i, j] : ends) {
    const Rigid3 motion_error = RelativeMotionError(pairs[i], pairs[j]);
    translations.push_back(motion_error.translation().norm());
    rotations.push_back(AngleOf(motion_error.rotation()));
  }
  return {StatisticsOf(translations), StatisticsOf(rotations)};
}

// Relative error over pairs that are `delta` apart. Stamps are those of the reference, paths in
// metres those of the estimate, as in evo.
RelativeError MeasureRelative(const std::vector<PosePair>& pairs, const RelativeDelta& delta,
                              double tolerance) {
  std::vector<double> stamps;
  for (const PosePair& pair : pairs) stamps.push_back(pair.reference.timestamp);
  return MeasureRelative(
      pairs, FindRelativePairs(stamps, Positions(pairs, &PosePair::estimate), delta, tolerance));
}

// Relative error from each pair to the first one that is `distance` metres further along the path,
// divided by the distance travelled.
RelativeError MeasurePerMetre(const std::vector<PosePair>& pairs,
                              const std::vector<double>& path_lengths, double distance) {
  std::vector<double> translations, rotations;
  size_t j = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    while (j < pairs.size() && path_lengths[j] - path_lengths[i] < distance) ++j;
    if (j == pairs.size()) break;
    const double travelled = path_lengths[j] - path_lengths[i];
    const Rigid3 motion_error = RelativeMotionError(pairs[i], pairs[j]);
    translations.push_back(motion_error.translation().norm() / travelled);
    rotations.push_back(AngleOf(motion_error.rotation()) / travelled);
  }
  return {StatisticsOf(translations), StatisticsOf(rotations)};
}

std::vector<Rigid3> PosesOf(const std::vector<PosePair>& pairs, TimedPose PosePair::*which) {
  std::vector<Rigid3> poses;
  for (const PosePair& pair : pairs) poses.push_back((pair.*which).world_from_cam);
  return poses;
}

// Why the pairs cannot be compared; empty if they can.
std::string DescribeProblem(const std::vector<PosePair>& pairs, const TrajectoryError& error,
                            const EvaluationOptions& options) {
  if (static_cast<int>(pairs.size()) >= kMinMatches) {
    if (options.alignment != Alignment::kSim3) return "";
    if (IsStatic(PosesOf(pairs, &PosePair::estimate))) {
      return "all positions of the estimate are the same, which determines no scale";
    }
    if (IsStatic(PosesOf(pairs, &PosePair::reference))) {
      return "all positions of the reference are the same, which determines no scale";
    }
    return "";
  }
  std::string problem = "only " + std::to_string(pairs.size()) + " of " +
                        std::to_string(error.num_estimate) +
                        " estimated poses have a reference pose within " +
                        FormatText("%g s; three are needed", options.max_time_difference);
  if (error.num_not_estimated > 0) {
    problem += "; " + std::to_string(error.num_not_estimated) +
               " others are marked as not estimated and left out";
  }
  return problem;
}

// What makes errors of the pairs doubtful.
std::vector<std::string> DescribeDoubts(const std::vector<PosePair>& pairs,
                                        const EvaluationOptions& options) {
  const std::vector<Rigid3> reference = PosesOf(pairs, &PosePair::reference);
  const std::vector<Rigid3> estimate = PosesOf(pairs, &PosePair::estimate);
  const bool with_scale = options.alignment == Alignment::kSim3;
  std::vector<std::string> doubts;
  if (with_scale || options.alignment == Alignment::kSe3) {
    doubts.push_back(DescribeUndetermined(reference, estimate, with_scale));
  }
  if (!with_scale) doubts.push_back(DescribeScaleContradiction(reference, estimate));
  doubts.push_back(DescribeOrientationContradiction(reference, estimate, options.estimate_is_own));
  doubts.erase(std::remove(doubts.begin(), doubts.end(), ""), doubts.end());
  return doubts;
}

// Number of poses between the first and the last stamp of others.
int NumInRange(const std::vector<TimedPose>& poses, const std::vector<TimedPose>& others,
               double max_time_difference) {
  return static_cast<int>(std::count_if(poses.begin(), poses.end(), [&](const TimedPose& pose) {
    return pose.timestamp >= others.front().timestamp - max_time_difference &&
           pose.timestamp <= others.back().timestamp + max_time_difference;
  }));
}

// Why the number of partners is doubtful; empty if it is not. At common times, all poses of the
// sparser trajectory should have one if the other is dense, or as many as chance gives if it is
// not.
std::string DescribeFewMatches(const std::vector<TimedPose>& reference,
                               const std::vector<TimedPose>& estimate, double max_time_difference,
                               const TrajectoryError& error) {
  const int num_estimate = NumInRange(estimate, reference, max_time_difference);
  const int num_expected = std::min(num_estimate, error.num_reference_in_range);
  const double common = std::min(reference.back().timestamp, estimate.back().timestamp) -
                        std::max(reference.front().timestamp, estimate.front().timestamp);
  const double rate = std::max(num_estimate, error.num_reference_in_range) / common;
  const double by_chance = std::min(1.0, 2.0 * max_time_difference * rate);
  if (!(common > 0.0) || error.num_matched >= 0.5 * by_chance * num_expected) return "";
  return FormatText(
      "only %d of %d poses at common times have a partner within %g s: are the time stamps of both "
      "in seconds of the same clock?",
      error.num_matched, num_expected, max_time_difference);
}

void MeasureCoverage(const std::vector<TimedPose>& reference,
                     const std::vector<TimedPose>& estimate, double max_time_difference,
                     TrajectoryError* error) {
  error->num_reference_in_range = NumInRange(reference, estimate, max_time_difference);
  error->coverage = static_cast<double>(error->num_matched) / error->num_reference;
  error->coverage_in_range =
      static_cast<double>(error->num_matched) / std::max(error->num_reference_in_range, 1);
}

}  // namespace

const char* ToString(Alignment alignment) {
  return EnumName<Alignment::kNone>(alignment, {"se3", "sim3", "origin", "none"});
}

Alignment AlignmentFromString(const std::string& name) {
  if (const auto alignment = EnumFromName<Alignment::kNone>(name)) return *alignment;
  throw std::invalid_argument("the alignment must be se3, sim3, origin or none, not '" + name +
                              "'");
}

bool EvaluationOptions::IsValid(std::string* error) const {
  if (!(max_time_difference >= 0.0)) {
    *error = "evaluation: max_time_difference must not be negative";
  } else if (!(rpe_seconds > 0.0) || !(rpe_metres > 0.0)) {
    *error = "evaluation: rpe_seconds and rpe_metres must be positive";
  } else if (const std::string problem = rpe_delta.Problem(); !problem.empty()) {
    *error = "evaluation: rpe_delta " + problem;
  } else {
    return true;
  }
  return false;
}

std::string DescribeRemedy(const TrajectoryError& error, const std::string& all_poses) {
  if (error.usable || error.num_matched >= kMinMatches) return "";
  return error.num_not_estimated > 0 ? all_poses + " compares them"
                                     : "are the time stamps of both in seconds of the same clock?";
}

TrajectoryError EvaluateTrajectory(const std::vector<TimedPose>& reference,
                                   const std::vector<TimedPose>& estimate,
                                   const EvaluationOptions& options) {
  std::string problem;
  if (!options.IsValid(&problem)) throw std::invalid_argument(problem);
  const std::vector<TimedPose> truth = SortedByTime(reference);
  const std::vector<TimedPose> compared = SelectCompared(estimate, options);

  std::vector<PosePair> pairs = MatchPoses(truth, compared, options.max_time_difference);
  TrajectoryError error;
  error.alignment = options.alignment;
  error.num_reference = static_cast<int>(truth.size());
  error.num_estimate = static_cast<int>(compared.size());
  error.num_not_estimated = static_cast<int>(estimate.size() - compared.size());
  error.num_matched = static_cast<int>(pairs.size());
  error.message = DescribeProblem(pairs, error, options);
  error.usable = error.message.empty();
  if (!error.usable) return error;
  error.warnings = DescribeDoubts(pairs, options);
  MeasureCoverage(truth, compared, options.max_time_difference, &error);
  const std::string few = DescribeFewMatches(truth, compared, options.max_time_difference, error);
  if (!few.empty()) error.warnings.push_back(few);

  error.scale = ScaleOf(pairs, options.alignment);
  for (PosePair& pair : pairs) pair.estimate.world_from_cam.translation() *= error.scale;
  const std::vector<double> path_lengths = PathLengths(Positions(pairs, &PosePair::reference));
  error.path_length = path_lengths.back();
  MeasureAbsolute(pairs, &error);
  const bool aligned =
      options.alignment == Alignment::kSe3 || options.alignment == Alignment::kSim3;
  error.rotation = aligned ? MeasureRotation(pairs) : error.ape_rotation;
  error.rpe = MeasureRelative(pairs, options.rpe_delta, options.max_time_difference);
  error.rpe_per_second = MeasureRelative(pairs, {options.rpe_seconds, DeltaUnit::kSeconds, true},
                                         options.max_time_difference);
  error.rpe_per_metre = MeasurePerMetre(pairs, path_lengths, options.rpe_metres);
  return error;
}

std::optional<Rigid3> AlignOrientations(const std::vector<TimedPose>& reference,
                                        const std::vector<TimedPose>& estimate,
                                        const EvaluationOptions& options) {
  std::string problem;
  if (!options.IsValid(&problem)) throw std::invalid_argument(problem);
  const std::vector<PosePair> pairs = MatchPoses(
      SortedByTime(reference), SelectCompared(estimate, options), options.max_time_difference);
  if (pairs.empty()) return std::nullopt;
  return AlignByOrientation(pairs);
}

std::vector<TimedPose> Transformed(const Rigid3& reference_from_estimate,
                                   std::vector<TimedPose> estimate, double scale) {
  for (TimedPose& pose : estimate) {
    pose.world_from_cam.translation() *= scale;
    pose.world_from_cam = reference_from_estimate * pose.world_from_cam;
  }
  return estimate;
}

std::vector<SegmentError> EvaluateSegments(const std::vector<TimedPose>& reference,
                                           const std::vector<TimedPose>& estimate,
                                           const EvaluationOptions& options) {
  std::map<int, std::vector<TimedPose>> segments;
  for (const TimedPose& pose : estimate) segments[pose.segment].push_back(pose);
  std::vector<SegmentError> errors;
  if (segments.size() < 2) return errors;
  for (const auto& [segment, poses] : segments) {
    errors.push_back({segment, poses.front().world, EvaluateTrajectory(reference, poses, options)});
  }
  return errors;
}

bool HasSeveralWorlds(const std::vector<TimedPose>& poses) {
  return std::any_of(poses.begin(), poses.end(),
                     [&poses](const TimedPose& pose) { return pose.world != poses.front().world; });
}

}  // namespace msc_vo
