// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/keyframe_rolling_shutter.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

namespace {

// Smallest change of the readout time (seconds) that is applied: at 70 degrees per second a
// millisecond shifts the first and the last row by 0.3 px, less than the sigma of a point.
constexpr double kMinReadoutChange = 0.001;

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
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> compensated;
  for (const auto& [id, keyframe] : map->keyframes()) {
    std::shared_ptr<const Frame> frame = UpdateCompensation(keyframe.frame, readout_time);
    if (frame != keyframe.frame) compensated.emplace_back(id, std::move(frame));
  }
  for (auto& [id, frame] : compensated) {
    map->SetFrame(id, std::move(frame));
    MoveExclusiveLandmarks(id, map);
  }
}

}  // namespace msc_vo
