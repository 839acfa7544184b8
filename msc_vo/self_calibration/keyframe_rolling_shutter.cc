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
constexpr double kMinChange = 0.001;

// Moves the landmarks that only this keyframe observes to their position in its frame.
void MoveExclusiveLandmarks(KeyframeId id, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  for (size_t i = 0; i < keyframe.points.size(); ++i) {
    const int feature = static_cast<int>(i);
    const PointLandmark* point = map->FindPoint(keyframe.points[i]);
    if (point == nullptr || point->observations.size() > 1) continue;
    if (!keyframe.frame->points[i].HasDepth()) continue;
    map->SetPoint(point->id, world_from_cam * keyframe.frame->PointInCamera(feature));
  }
  for (size_t i = 0; i < keyframe.lines.size(); ++i) {
    const int feature = static_cast<int>(i);
    const LineLandmark* line = map->FindLine(keyframe.lines[i]);
    if (line == nullptr || line->observations.size() > 1) continue;
    if (!keyframe.frame->lines[i].depth) continue;
    map->SetLine(line->id, world_from_cam * keyframe.frame->LineInCamera(feature));
  }
}

}  // namespace

void SetKeyframeVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map) {
  const Keyframe* old = map->FindKeyframe(keyframe);
  if (old == nullptr) return;
  map->SetFrame(keyframe, std::make_shared<Frame>(CompensateRollingShutter(
                              *old->frame, velocity, old->frame->readout_time)));
}

std::shared_ptr<const Frame> UpdateCompensation(std::shared_ptr<const Frame> frame,
                                                double readout_time) {
  if (!frame->velocity || std::abs(frame->readout_time - readout_time) < kMinChange) {
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
