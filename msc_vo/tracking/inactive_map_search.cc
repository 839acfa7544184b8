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
        Relocalize(tracked, *candidate.map, *candidate.keyframe);
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
                                                               const Map& map,
                                                               const Keyframe& keyframe) const {
  const Frame& frame = *tracked.frame;
  const std::optional<Relocalization> hit =
      msc_vo::Relocalize(options_.relocalizer, options_.line_matcher, frame, map, keyframe);
  if (!hit) return std::nullopt;
  TrackedFrame found;
  found.frame = tracked.frame;
  found.noise_scale = tracked.noise_scale;
  found.cam_from_world = hit->cam_from_world;
  found.matches = hit->matches;
  // The local map confirms the pose with the landmarks of several keyframes.
  const auto estimate = [&] {
    found.pose = EstimateFramePose(options_.pose, frame, map, found.noise_scale, {},
                                   &found.cam_from_world, &found.matches);
    return HasEnoughInliers(options_, found);
  };
  if (!estimate()) return std::nullopt;
  const LocalMap local = SelectLocalMap(map, frame, found.cam_from_world, found.matches,
                                        keyframe.id, options_.max_local_keyframes);
  found.matches = MatchLocalMap(options_, frame, local, options_.local_map_radius,
                                LandmarkInliers(found.matches));
  if (!estimate()) return std::nullopt;
  if (ClassifyStatus(options_, found.pose) != TrackingStatus::kTracked) return std::nullopt;
  found.matches = LandmarkInliers(found.matches);
  if (!HasComparableMatchRatio(found.matches, local, tracked)) return std::nullopt;
  const Rigid3 cam_from_reference =
      found.cam_from_world * map.CamFromWorld(local.reference).Inverse();
  return MapRelocalization{local.reference, cam_from_reference, found.pose.covariance,
                           found.matches};
}

}  // namespace msc_vo
