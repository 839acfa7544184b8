// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/keyframe_frames.h"

#include <cmath>
#include <utility>
#include <vector>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

namespace {

// Moves the landmarks of a kind to the positions that the first of their observations with a depth
// measures, and clears Landmark::has_false_depth, which was found with the calibration so far.
template <typename L>
void MoveLandmarks(Map* map) {
  std::vector<std::pair<LandmarkId, typename L::Geometry>> moved;
  for (const auto& [id, landmark] : map->landmarks<L>()) {
    if (map->IsOfEarlierSession(landmark.observations.front().keyframe)) continue;
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = *map->FindKeyframe(observation.keyframe);
      if (!FeaturesOf<L>(*keyframe.frame)[observation.feature].HasDepth()) continue;
      moved.emplace_back(id, keyframe.cam_from_world.Inverse() *
                                 L::InCamera(*keyframe.frame, observation.feature));
      break;
    }
  }
  for (const auto& [id, geometry] : moved) {
    map->SetGeometry<L>(id, geometry);
    map->SetHasFalseDepth<L>(id, false);
  }
}

template <typename L>
void RefreshAll(Map* map) {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : map->landmarks<L>()) ids.push_back(id);
  for (const LandmarkId id : ids) map->Refresh<L>(id);
}

// Returns the ids of the keyframes that have another frame now.
std::vector<KeyframeId> ReplaceFrames(const KeyframeUpdate& update, Map* map) {
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> frames;
  for (const auto& [id, keyframe] : map->keyframes()) {
    std::shared_ptr<const Frame> frame = update(id, keyframe.frame);
    if (frame != keyframe.frame) frames.emplace_back(id, std::move(frame));
  }
  std::vector<KeyframeId> replaced;
  for (auto& [id, frame] : frames) {
    map->SetFrame(id, std::move(frame));
    replaced.push_back(id);
  }
  return replaced;
}

// Moves the landmarks of a kind that only this keyframe observes to their position in its frame.
template <typename L>
void MoveExclusiveLandmarks(const Keyframe& keyframe, Map* map) {
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  const std::vector<LandmarkId>& slots = SlotsOf<L>(keyframe);
  for (size_t i = 0; i < slots.size(); ++i) {
    const int feature = static_cast<int>(i);
    const L* landmark = map->Find<L>(slots[i]);
    if (landmark == nullptr || landmark->observations.size() > 1) continue;
    if (!FeaturesOf<L>(*keyframe.frame)[i].HasDepth()) continue;
    map->SetGeometry<L>(landmark->id, world_from_cam * L::InCamera(*keyframe.frame, feature));
  }
}

void MoveExclusiveLandmarks(KeyframeId id, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);
  ForEachLandmarkKind(
      [&](auto kind) { MoveExclusiveLandmarks<typename decltype(kind)::Landmark>(keyframe, map); });
}

}  // namespace

void ChangeKeyframeCamera(const PinholeCamera& camera, Map* map) {
  ReplaceFrames(
      [&](KeyframeId /*id*/, const std::shared_ptr<const Frame>& frame) {
        return ChangeCamera(frame, camera);
      },
      map);
  // The distance at which a patch has the size of a pyramid level depends on the camera.
  ForEachLandmarkKind([map](auto kind) { RefreshAll<typename decltype(kind)::Landmark>(map); });
}

void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map) {
  ReplaceFrames(update, map);
  ForEachLandmarkKind([map](auto kind) { MoveLandmarks<typename decltype(kind)::Landmark>(map); });
}

void SetKeyframeVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map) {
  const Keyframe* old = map->FindKeyframe(keyframe);
  if (old == nullptr) return;
  auto frame = std::make_shared<Frame>(
      CompensateRollingShutter(*old->frame, velocity, old->frame->readout_time));
  SetDepthVelocity(velocity, frame.get());
  map->SetFrame(keyframe, frame);
}

std::shared_ptr<const Frame> UpdateCompensation(std::shared_ptr<const Frame> frame,
                                                double readout_time) {
  if (!frame->velocity || std::abs(frame->readout_time - readout_time) < kMinReadoutChange) {
    return frame;
  }
  return std::make_shared<Frame>(CompensateRollingShutter(*frame, *frame->velocity, readout_time));
}

void CompensateKeyframes(double readout_time, Map* map) {
  const std::vector<KeyframeId> compensated = ReplaceFrames(
      [&](KeyframeId /*id*/, const std::shared_ptr<const Frame>& frame) {
        return UpdateCompensation(frame, readout_time);
      },
      map);
  for (const KeyframeId id : compensated) MoveExclusiveLandmarks(id, map);
}

}  // namespace msc_vo
