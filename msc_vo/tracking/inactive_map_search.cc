// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/inactive_map_search.h"

#include <memory>

#include "msc_vo/map/map_alignment.h"
#include "msc_vo/pose_estimation/relocalizer.h"
#include "msc_vo/tracking/frame_pose.h"
#include "msc_vo/tracking/pose_support.h"
#include "msc_vo/tracking/search_budget.h"

namespace msc_vo {

namespace {

// In 1/30 s, and at least one per frame: bounds the cost.
constexpr int kKeyframesToTry = 1;
// Consecutive ones with one keyframe.
constexpr int kMaxSuccesses = 2 * kMinAlignedFrames;

size_t NumKeyframes(const InactiveMaps& maps) {
  size_t count = 0;
  for (const std::shared_ptr<const Map>& map : maps) count += map->keyframes().size();
  return count;
}

}  // namespace

std::optional<MapRelocalization> InactiveMapSearch::Search(const TrackedFrame& tracked,
                                                           const MapSnapshot& snapshot,
                                                           double seconds) {
  const InactiveMaps& maps = snapshot.inactive_maps;
  if (maps.empty() || tracked.status != TrackingStatus::kTracked) return std::nullopt;
  const double timestamp = tracked.frame->timestamp;
  if (timestamp - last_success_ < options_.segments.search_interval) return std::nullopt;
  const int num_keyframes = KeyframesToTry(kKeyframesToTry, seconds, NumKeyframes(maps));
  for (int i = 0; i < num_keyframes; ++i) {
    const Candidate candidate = NextCandidate(maps);
    if (candidate.keyframe->id != next_) num_successes_ = 0;
    std::optional<MapRelocalization> found =
        Relocalize(tracked, snapshot.noise_scale, *candidate.map, *candidate.keyframe);
    if (found && ++num_successes_ < kMaxSuccesses) {
      next_ = candidate.keyframe->id;
    } else {
      next_ = candidate.keyframe->id - 1;
      num_successes_ = 0;
    }
    if (found) {
      last_success_ = timestamp;
      return found;
    }
  }
  return std::nullopt;
}

InactiveMapSearch::Candidate InactiveMapSearch::NextCandidate(const InactiveMaps& maps) {
  for (;;) {
    Candidate candidate;
    for (const std::shared_ptr<const Map>& map : maps) {
      const auto* entry = map->keyframes().FindUpTo(next_);
      if (entry == nullptr) continue;
      if (candidate.keyframe != nullptr && candidate.keyframe->id > entry->first) continue;
      candidate = {map.get(), &entry->second};
    }
    if (candidate.keyframe != nullptr) return candidate;
    next_ = std::numeric_limits<KeyframeId>::max();  // all have been tried: begin with the newest
  }
}

std::optional<MapRelocalization> InactiveMapSearch::Relocalize(const TrackedFrame& tracked,
                                                               const NoiseScale& noise_scale,
                                                               const Map& map,
                                                               const Keyframe& keyframe) const {
  const Frame& frame = *tracked.frame;
  const std::optional<Relocalization> hit = msc_vo::Relocalize(
      options_.relocalizer, options_.matchers.line_matcher, frame, map, keyframe);
  if (!hit) return std::nullopt;
  const std::vector<PoseFactor> no_factors;
  PoseEstimator estimator(options_, map, noise_scale, no_factors);
  const std::optional<FramePose> first =
      estimator.Estimate(options_.pose, frame, hit->cam_from_world, hit->matches);
  if (!first) return std::nullopt;
  // The local map confirms the pose with the landmarks of several keyframes.
  const LocalMap local = SelectLocalMap(map, frame, first->cam_from_world, first->matches,
                                        keyframe.id, options_.max_local_keyframes);
  const std::optional<FramePose> pose =
      estimator.MatchAndEstimate(options_.pose, frame, local, options_.local_map_radius,
                                 first->cam_from_world, LandmarkInliers(first->matches));
  if (!pose || ClassifyStatus(options_, pose->summary) != TrackingStatus::kTracked) {
    return std::nullopt;
  }
  const FrameMatches matches = LandmarkInliers(pose->matches);
  if (!HasComparableMatchRatio(matches, local, tracked)) return std::nullopt;
  return MapRelocalization{local.reference,
                           pose->cam_from_world * map.CamFromWorld(local.reference).Inverse(),
                           pose->summary.covariance, matches};
}

}  // namespace msc_vo
