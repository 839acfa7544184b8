// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_joiner.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

namespace {

// Lets keyframe `id` observe the points of the other map that its features were matched with. Where
// a feature has a point already, the two are one.
void MergeMatchedPoints(KeyframeId id, const std::vector<PointMatch>& matches, Map* map) {
  for (const PointMatch& match : matches) {
    if (map->FindPoint(match.id) == nullptr) continue;  // merged by an earlier match
    const LandmarkId holder = map->FindKeyframe(id)->points[match.feature];
    if (holder == match.id) continue;
    if (holder == kNoId) {
      map->ObservePoint(match.id, id, match.feature);
    } else {
      map->MergePoints(holder, match.id);
    }
    map->RefreshPoint(match.id);
  }
}

void MergeMatchedLines(KeyframeId id, const std::vector<LineMatch>& matches, Map* map) {
  for (const LineMatch& match : matches) {
    if (map->FindLine(match.id) == nullptr) continue;  // merged by an earlier match
    const LandmarkId holder = map->FindKeyframe(id)->lines[match.feature];
    if (holder == match.id) continue;
    if (holder == kNoId) {
      map->ObserveLine(match.id, id, match.feature);
    } else {
      map->MergeLines(holder, match.id);
    }
    map->RefreshLine(match.id);
  }
}

}  // namespace

void MapJoiner::Add(KeyframeId keyframe, const PoseCovariance& covariance,
                    const MapRelocalization& in_inactive_map) {
  // Older keyframes have drifted more, and wrong ones must not outvote the others for ever.
  constexpr size_t kMaxSightings = 10;
  if (sightings_.size() == kMaxSightings) sightings_.erase(sightings_.begin());
  sightings_.push_back({keyframe, covariance, in_inactive_map});
}

std::vector<MapJoiner::Sighting> MapJoiner::SightingsIn(const Map& map) const {
  std::vector<Sighting> sightings;
  for (const Sighting& sighting : sightings_) {
    if (map.KnowsKeyframe(sighting.in_inactive_map.reference)) sightings.push_back(sighting);
  }
  return sightings;
}

std::optional<MapJoin> MapJoiner::TryJoin(Atlas* atlas) {
  if (sightings_.empty()) return std::nullopt;
  const KeyframeId reference = sightings_.back().in_inactive_map.reference;
  const Map* inactive = FindMapOf(atlas->inactive(), reference);
  if (inactive == nullptr) return std::nullopt;
  const bool inactive_is_kept = IsOlder(*inactive, atlas->current());
  const std::vector<Sighting> sightings = SightingsIn(*inactive);
  std::vector<FrameInTwoMaps> frames;  // a: the map that is moved, b: the one that is kept
  for (const Sighting& sighting : sightings) {
    const MapRelocalization& other = sighting.in_inactive_map;
    FrameInTwoMaps frame{atlas->current().CamFromWorld(sighting.keyframe),
                         other.cam_from_reference * inactive->CamFromWorld(other.reference),
                         sighting.covariance, other.covariance};
    if (!inactive_is_kept) {
      std::swap(frame.cam_from_a, frame.cam_from_b);
      std::swap(frame.covariance_a, frame.covariance_b);
    }
    frames.push_back(frame);
  }
  const std::optional<MapAlignment> alignment = AlignMaps(options_, frames);
  if (!alignment) return std::nullopt;

  MapJoin join;
  join.kept = inactive->keyframes().front().first;
  join.moved = atlas->current().keyframes().front().first;
  if (!inactive_is_kept) std::swap(join.kept, join.moved);
  join.moved_from_kept = alignment->a_from_b;
  join.covariance = alignment->covariance;
  join.num_keyframes =
      static_cast<int>(std::count(alignment->inliers.begin(), alignment->inliers.end(), true));
  atlas->Join(reference, inactive_is_kept ? join.moved_from_kept : join.moved_from_kept.Inverse());
  for (size_t i = 0; i < sightings.size(); ++i) {
    const KeyframeId keyframe = sightings[i].keyframe;
    if (!alignment->inliers[i] || atlas->current().FindKeyframe(keyframe) == nullptr) continue;
    const FrameMatches& matches = sightings[i].in_inactive_map.matches;
    MergeMatchedPoints(keyframe, matches.points, &atlas->current());
    MergeMatchedLines(keyframe, matches.lines, &atlas->current());
  }
  sightings_.erase(
      std::remove_if(sightings_.begin(), sightings_.end(),
                     [&](const Sighting& sighting) {
                       return atlas->current().KnowsKeyframe(sighting.in_inactive_map.reference);
                     }),
      sightings_.end());
  return join;
}

}  // namespace msc_vo
