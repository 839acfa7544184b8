// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/look_alikes.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/map/free_space.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/map/path_covariance.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/tracking/frame_pose.h"
#include "msc_vo/tracking/pose_support.h"

namespace msc_vo {

namespace {

// Alignments that are remembered, because each of them costs a search in the map for every frame
// that is found. With more of them, no frame is used until maps have been joined or left.
constexpr int kMaxAlignments = 16;

Eigen::Vector3d PlaceOf(const PointCandidate& point) { return point.position; }

Eigen::Vector3d PlaceOf(const LineCandidate& line) {
  return 0.5 * (line.segment.start + line.segment.end);
}

// The landmarks of a map that should be visible from a pose, without those that the depth image of
// the frame does not show as visible: they are occluded, or it has no depth there.
LocalMap LandmarksWithDepth(const Map& map, const Frame& frame, const Rigid3& cam_from_world) {
  LocalMap local = SelectVisibleLandmarks(map, frame, cam_from_world);
  const auto is_hidden = [&](const auto& candidate) {
    const Eigen::Vector3d place = cam_from_world * PlaceOf(candidate);
    return !ShowsSurface(frame, place) && !IsInFreeSpace(frame, place);
  };
  ForEachLandmarkKind([&](auto kind) {
    auto& candidates = local.Of<typename decltype(kind)::Landmark>();
    EraseIf(&candidates, is_hidden);
  });
  return local;
}

MatchCounts CountMatchesAt(const TrackerOptions& options, const Frame& frame, const Map& map,
                           const NoiseScale& noise_scale, const Rigid3& cam_from_world) {
  const LocalMap local = LandmarksWithDepth(map, frame, cam_from_world);
  const std::vector<PoseFactor> no_factors;
  PoseEstimator estimator(options, map, noise_scale, no_factors);
  const std::optional<FramePose> pose = estimator.MatchAndEstimate(
      options.pose, frame, local, options.prediction_radius, cam_from_world);
  return {SizesOf(local), pose ? Sum(SizesOf(LandmarkInliers(pose->matches))) : 0};
}

// Whether a frame can be at a place.
enum class PlaceStatus {
  kPossible,
  kUnknown,   // the map does not cover its view there
  kExcluded,  // the frame does not match the map there
};

PlaceStatus ClassifyPlace(const Frame& frame, const MatchCounts& place, const MatchCounts& found) {
  // Relative to the place that was found: where the frame could match fewer landmarks, the map does
  // not show most of what the frame shows, so that missing matches prove nothing.
  constexpr double kMinCoverage = 0.5;
  const int num_matchable = NumMatchable(frame, place, found);
  if (num_matchable == 0 || num_matchable < kMinCoverage * NumMatchable(frame, found, place)) {
    return PlaceStatus::kUnknown;
  }
  return HasComparableMatchRatio(frame, place, found) ? PlaceStatus::kPossible
                                                      : PlaceStatus::kExcluded;
}

}  // namespace

void LookAlikes::Add(const TrackedFrame& tracked, const MapSnapshot& snapshot, const Map& map,
                     const Revisit& found) {
  if (!snapshot.map.KnowsKeyframe(tracked.reference)) return;
  if (static_cast<int>(alignments_.size()) == kMaxAlignments) return;
  const std::vector<bool> same = AreSame(tracked, snapshot, map, found);
  if (std::find(same.begin(), same.end(), true) != same.end()) return;
  alignments_.push_back({tracked.reference, found.reference,
                         found.cam_from_reference.Inverse() * tracked.cam_from_reference});
}

bool LookAlikes::AreExcluded(const TrackerOptions& options, const TrackedFrame& tracked,
                             const MapSnapshot& snapshot, const Map& map,
                             const Revisit& found) const {
  if (!snapshot.map.KnowsKeyframe(tracked.reference)) return alignments_.empty();
  if (static_cast<int>(alignments_.size()) == kMaxAlignments) return false;  // there may be more
  const Rigid3 found_from_world = found.cam_from_reference * map.CamFromWorld(found.reference);
  const Frame& frame = *tracked.frame;
  const auto counts_at = [&](const Rigid3& cam_from_world) {
    return CountMatchesAt(options, frame, map, snapshot.noise_scale, cam_from_world);
  };
  const std::vector<bool> same = AreSame(tracked, snapshot, map, found);
  std::optional<MatchCounts> at_found;
  for (size_t i = 0; i < alignments_.size(); ++i) {
    const Alignment& alignment = alignments_[i];
    if (same[i] || !map.KnowsKeyframe(alignment.other)) continue;
    if (!at_found) at_found = counts_at(found_from_world);
    const Rigid3 aligned_from_world = PoseBy(alignment, tracked, snapshot.map, map);
    const PlaceStatus status = ClassifyPlace(frame, counts_at(aligned_from_world), *at_found);
    if (status == PlaceStatus::kExcluded) continue;
    if (status == PlaceStatus::kPossible) return false;
    // In a row of look-alikes, the place that was found has a copy on its other side, too.
    const Rigid3 opposite_from_world =
        found_from_world * aligned_from_world.Inverse() * found_from_world;
    const PlaceStatus opposite = ClassifyPlace(frame, counts_at(opposite_from_world), *at_found);
    if (opposite != PlaceStatus::kExcluded) return false;
  }
  return true;
}

void LookAlikes::Update(const MapSnapshot& snapshot) {
  EraseIf(&alignments_, [&snapshot](const Alignment& alignment) {
    return !snapshot.map.KnowsKeyframe(alignment.own) ||
           FindMapOf(snapshot.inactive_maps, alignment.other) == nullptr;
  });
}

std::vector<bool> LookAlikes::AreSame(const TrackedFrame& tracked, const MapSnapshot& snapshot,
                                      const Map& map, const Revisit& found) const {
  std::vector<bool> same(alignments_.size(), false);
  if (alignments_.empty()) return same;
  const Rigid3 found_from_world = found.cam_from_reference * map.CamFromWorld(found.reference);
  const PathCovariances own_paths(snapshot.map, snapshot.loops, tracked.reference);
  const PathCovariances paths(map, snapshot.loops, found.reference);
  for (size_t i = 0; i < alignments_.size(); ++i) {
    const Alignment& alignment = alignments_[i];
    if (!map.KnowsKeyframe(alignment.other)) continue;
    const Rigid3 aligned_from_world = PoseBy(alignment, tracked, snapshot.map, map);
    const Rigid3 world_from_other = map.CamFromWorld(alignment.other).Inverse();
    const PoseCovariance covariance =
        2.0 * ViewCovariance() + found.covariance +
        TransportCovariance(tracked.cam_from_reference, own_paths.OfRoot(alignment.own)) +
        TransportCovariance(found.cam_from_reference, paths.OfRoot(alignment.other));
    same[i] = IsPossibleDrift(found_from_world * world_from_other,
                              aligned_from_world * world_from_other, covariance);
  }
  return same;
}

Rigid3 LookAlikes::PoseBy(const Alignment& alignment, const TrackedFrame& tracked, const Map& own,
                          const Map& map) {
  return tracked.cam_from_world * own.CamFromWorld(alignment.own).Inverse() *
         alignment.other_from_own.Inverse() * map.CamFromWorld(alignment.other);
}

}  // namespace msc_vo
