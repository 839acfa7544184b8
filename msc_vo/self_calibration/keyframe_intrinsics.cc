// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/keyframe_intrinsics.h"

#include <utility>
#include <vector>

namespace msc_vo {

namespace {

// The first keyframe with an observation of the landmark that `has_depth`; nullptr: none.
template <typename HasDepth>
std::pair<const Keyframe*, int> FirstWithDepth(const Map& map, const Landmark& landmark,
                                               const HasDepth& has_depth) {
  for (const Observation& observation : landmark.observations) {
    const Keyframe* keyframe = map.FindKeyframe(observation.keyframe);
    if (has_depth(*keyframe->frame, observation.feature)) return {keyframe, observation.feature};
  }
  return {nullptr, 0};
}

void MovePoints(Map* map) {
  std::vector<std::pair<LandmarkId, Eigen::Vector3d>> moved;
  for (const auto& [id, point] : map->points()) {
    const auto [keyframe, feature] = FirstWithDepth(
        *map, point, [](const Frame& frame, int i) { return frame.points[i].HasDepth(); });
    if (keyframe == nullptr) continue;
    moved.emplace_back(
        id, keyframe->cam_from_world.Inverse() * keyframe->frame->PointInCamera(feature));
  }
  for (const auto& [id, position] : moved) map->SetPoint(id, position);
}

void MoveLines(Map* map) {
  std::vector<std::pair<LandmarkId, LineSegment3>> moved;
  for (const auto& [id, line] : map->lines()) {
    const auto [keyframe, feature] = FirstWithDepth(
        *map, line, [](const Frame& frame, int i) { return frame.lines[i].depth.has_value(); });
    if (keyframe == nullptr) continue;
    moved.emplace_back(id,
                       keyframe->cam_from_world.Inverse() * keyframe->frame->LineInCamera(feature));
  }
  for (const auto& [id, segment] : moved) map->SetLine(id, segment);
}

}  // namespace

void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map) {
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> frames;
  for (const auto& [id, keyframe] : map->keyframes()) {
    frames.emplace_back(id, update(id, keyframe.frame));
  }
  for (auto& [id, frame] : frames) map->SetFrame(id, std::move(frame));
  MovePoints(map);
  MoveLines(map);
}

}  // namespace msc_vo
