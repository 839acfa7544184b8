// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "msc_vo/evaluation/association.h"
#include "msc_vo/geometry/rigid_alignment.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Matched poses of reference and estimate, both camera in world.
struct PosePair {
  TimedPose reference;
  TimedPose estimate;
};

std::vector<TimedPose> SortedByTime(std::vector<TimedPose> poses) {
  std::stable_sort(poses.begin(), poses.end(), [](const TimedPose& a, const TimedPose& b) {
    return a.timestamp < b.timestamp;
  });
  return poses;
}

std::vector<double> Stamps(const std::vector<TimedPose>& poses) {
  std::vector<double> stamps;
  stamps.reserve(poses.size());
  for (const TimedPose& pose : poses) stamps.push_back(pose.timestamp);
  return stamps;
}

// Selects the poses to be compared, in order of time.
std::vector<TimedPose> SelectCompared(std::vector<TimedPose> estimate,
                                      const EvaluationOptions& options) {
  if (!options.all_poses) {
    estimate.erase(std::remove_if(estimate.begin(), estimate.end(),
                                  [](const TimedPose& pose) { return !pose.is_estimated; }),
                   estimate.end());
  }
  return SortedByTime(std::move(estimate));
}

// Matches poses by time; both trajectories must be in order of time.
std::vector<PosePair> MatchPoses(const std::vector<TimedPose>& reference,
                                 const std::vector<TimedPose>& estimate,
                                 double max_time_difference) {
  std::vector<PosePair> pairs;
  for (const StampMatch& match :
       AssociateStamps(Stamps(reference), Stamps(estimate), max_time_difference)) {
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

// Aligns orientations and mean positions.
Rigid3 AlignByOrientation(const std::vector<PosePair>& pairs) {
  std::vector<Rigid3> source, target;
  for (const PosePair& pair : pairs) {
    source.push_back(pair.estimate.world_from_cam);
    target.push_back(pair.reference.world_from_cam);
  }
  return AlignPoses(source, target);
}

Rigid3 AlignByPosition(const std::vector<PosePair>& pairs) {
  std::vector<Eigen::Vector3d> source, target;
  for (const PosePair& pair : pairs) {
    source.push_back(pair.estimate.world_from_cam.translation());
    target.push_back(pair.reference.world_from_cam.translation());
  }
  return AlignRigid(source, target);
}

Rigid3 Align(const std::vector<PosePair>& pairs, Alignment alignment) {
  if (alignment == Alignment::kNone) return {};
  return alignment == Alignment::kOrientations ? AlignByOrientation(pairs) : AlignByPosition(pairs);
}

// Computes the alignment and the absolute errors after it.
void MeasureAbsolute(const std::vector<PosePair>& pairs, Alignment alignment,
                     TrajectoryError* error) {
  error->reference_from_estimate = Align(pairs, alignment);
  std::vector<double> translations, rotations;
  for (const PosePair& pair : pairs) {
    const Rigid3 aligned = error->reference_from_estimate * pair.estimate.world_from_cam;
    const Rigid3& truth = pair.reference.world_from_cam;
    translations.push_back((aligned.translation() - truth.translation()).norm());
    rotations.push_back(AngleOf(truth.rotation().conjugate() * aligned.rotation()));
    error->per_pose.push_back({pair.estimate.timestamp, translations.back(), rotations.back()});
  }
  error->ape = StatisticsOf(translations);
  error->ape_rotation = StatisticsOf(rotations);
}

ErrorStatistics MeasureRotation(const std::vector<PosePair>& pairs, Alignment alignment) {
  const Rigid3 aligned =
      Align(pairs, alignment == Alignment::kNone ? alignment : Alignment::kOrientations);
  const Eigen::Quaterniond reference_from_estimate(aligned.rotation());
  std::vector<double> angles;
  for (const PosePair& pair : pairs) {
    angles.push_back(AngleOf(pair.reference.world_from_cam.rotation().conjugate() *
                             reference_from_estimate * pair.estimate.world_from_cam.rotation()));
  }
  return StatisticsOf(angles);
}

// Relative error over pairs whose reference stamps are `interval` seconds apart, within the
// tolerance.
RelativeError MeasurePerSecond(const std::vector<PosePair>& pairs, double interval,
                               double tolerance) {
  std::vector<double> translations, rotations;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const double target = pairs[i].reference.timestamp + interval;
    const auto after = std::lower_bound(
        pairs.begin(), pairs.end(), target,
        [](const PosePair& pair, double stamp) { return pair.reference.timestamp < stamp; });
    const size_t next = after - pairs.begin();
    const auto distance = [&](size_t k) {
      return std::abs(pairs[k].reference.timestamp - pairs[i].reference.timestamp - interval);
    };
    // Selects the closer of the stamps on both sides of the target, if it is later than i.
    size_t j = 0;
    if (next > i + 1) j = next - 1;
    if (next > i && next < pairs.size() && (j == 0 || distance(next) < distance(j))) j = next;
    if (j == 0 || distance(j) > tolerance) continue;
    const Rigid3 motion_error = RelativeMotionError(pairs[i], pairs[j]);
    translations.push_back(motion_error.translation().norm());
    rotations.push_back(AngleOf(motion_error.rotation()));
  }
  return {StatisticsOf(translations), StatisticsOf(rotations)};
}

// Path length of the reference up to each pair, metres.
std::vector<double> PathLengths(const std::vector<PosePair>& pairs) {
  std::vector<double> lengths = {0.0};
  for (size_t i = 1; i < pairs.size(); ++i) {
    const Eigen::Vector3d step = pairs[i].reference.world_from_cam.translation() -
                                 pairs[i - 1].reference.world_from_cam.translation();
    lengths.push_back(lengths.back() + step.norm());
  }
  return lengths;
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

}  // namespace

Alignment AlignmentFromString(const std::string& name) {
  if (name == "positions") return Alignment::kPositions;
  if (name == "orientations") return Alignment::kOrientations;
  if (name == "none") return Alignment::kNone;
  throw std::invalid_argument("the alignment must be positions, orientations or none, not '" +
                              name + "'");
}

bool EvaluationOptions::IsValid(std::string* error) const {
  if (!(max_time_difference >= 0.0)) {
    *error = "evaluation: max_time_difference must not be negative";
  } else if (!(rpe_seconds > 0.0) || !(rpe_metres > 0.0)) {
    *error = "evaluation: rpe_seconds and rpe_metres must be positive";
  } else {
    return true;
  }
  return false;
}

TrajectoryError EvaluateTrajectory(const std::vector<TimedPose>& reference,
                                   const std::vector<TimedPose>& estimate,
                                   const EvaluationOptions& options) {
  std::string problem;
  if (!options.IsValid(&problem)) throw std::invalid_argument(problem);
  const std::vector<TimedPose> truth = SortedByTime(reference);
  const std::vector<TimedPose> compared = SelectCompared(estimate, options);

  const std::vector<PosePair> pairs = MatchPoses(truth, compared, options.max_time_difference);
  TrajectoryError error;
  error.num_reference = static_cast<int>(truth.size());
  error.num_estimate = static_cast<int>(compared.size());
  error.num_not_estimated = static_cast<int>(estimate.size() - compared.size());
  error.num_matched = static_cast<int>(pairs.size());
  if (pairs.size() < 3) {
    error.message = "only " + std::to_string(pairs.size()) + " of " +
                    std::to_string(compared.size()) +
                    " estimated poses have a reference pose within " +
                    std::to_string(options.max_time_difference) + " s; three are needed";
    if (error.num_not_estimated > 0) {
      error.message += "; " + std::to_string(error.num_not_estimated) +
                       " others are marked as not estimated and left out";
    }
    return error;
  }
  error.usable = true;
  for (const TimedPose& pose : truth) {
    error.num_reference_in_range +=
        pose.timestamp >= compared.front().timestamp - options.max_time_difference &&
        pose.timestamp <= compared.back().timestamp + options.max_time_difference;
  }
  error.coverage = static_cast<double>(error.num_matched) / error.num_reference;
  error.coverage_in_range =
      static_cast<double>(error.num_matched) / std::max(error.num_reference_in_range, 1);

  const std::vector<double> path_lengths = PathLengths(pairs);
  error.path_length = path_lengths.back();
  MeasureAbsolute(pairs, options.alignment, &error);
  error.rotation = MeasureRotation(pairs, options.alignment);
  error.rpe_per_second = MeasurePerSecond(pairs, options.rpe_seconds, options.max_time_difference);
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
                                   std::vector<TimedPose> estimate) {
  for (TimedPose& pose : estimate) {
    pose.world_from_cam = reference_from_estimate * pose.world_from_cam;
  }
  return estimate;
}

}  // namespace msc_vo
