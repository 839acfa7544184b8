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
  constexpr size_t kMaxCommonKeyframes = 10;
  if (common_keyframes_.size() == kMaxCommonKeyframes)
    common_keyframes_.erase(common_keyframes_.begin());
  common_keyframes_.push_back({keyframe, covariance, in_inactive_map});
}

std::vector<MapJoiner::CommonKeyframe> MapJoiner::CommonKeyframesWith(const Map& map) const {
  std::vector<CommonKeyframe> common_keyframes;
  for (const CommonKeyframe& common : common_keyframes_) {
    if (map.KnowsKeyframe(common.in_inactive_map.reference)) common_keyframes.push_back(common);
  }
  return common_keyframes;
}

std::optional<MapJoin> MapJoiner::TryJoin(Atlas* atlas) {
  if (common_keyframes_.empty()) return std::nullopt;
  const KeyframeId reference = common_keyframes_.back().in_inactive_map.reference;
  const Map* inactive = FindMapOf(atlas->inactive(), reference);
  if (inactive == nullptr) return std::nullopt;
  const bool inactive_is_kept = IsOlder(*inactive, atlas->current());
  const std::vector<CommonKeyframe> in_both = CommonKeyframesWith(*inactive);
  std::vector<FrameInTwoMaps> frames;  // a: the map that is moved, b: the one that is kept
  for (const CommonKeyframe& common : in_both) {
    const MapRelocalization& other = common.in_inactive_map;
    FrameInTwoMaps frame{atlas->current().CamFromWorld(common.keyframe),
                         other.cam_from_reference * inactive->CamFromWorld(other.reference),
                         common.covariance, other.covariance};
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
  for (size_t i = 0; i < in_both.size(); ++i) {
    const KeyframeId keyframe = in_both[i].keyframe;
    if (!alignment->inliers[i] || atlas->current().FindKeyframe(keyframe) == nullptr) continue;
    const FrameMatches& matches = in_both[i].in_inactive_map.matches;
    MergeMatchedPoints(keyframe, matches.points, &atlas->current());
    MergeMatchedLines(keyframe, matches.lines, &atlas->current());
  }
  common_keyframes_.erase(
      std::remove_if(common_keyframes_.begin(), common_keyframes_.end(),
                     [&](const CommonKeyframe& common) {
                       return atlas->current().KnowsKeyframe(common.in_inactive_map.reference);
                     }),
      common_keyframes_.end());
  return join;
}

}  // namespace msc_vo
