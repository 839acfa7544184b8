// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_unrolling.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "msc_vo/map/rolling_shutter.h"

namespace msc_vo {

namespace {

// Seconds: at 70 degrees per second this moves the first and the last row by 0.3 px, less than the
// sigma of a point.
constexpr double kMaxDifference = 0.001;

}  // namespace

void SetVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map) {
  const Keyframe* old = map->FindKeyframe(keyframe);
  if (old == nullptr) return;
  map->SetFrame(keyframe,
                std::make_shared<Frame>(Unroll(*old->frame, velocity, old->frame->readout_time)));
}

void UnrollKeyframes(double readout_time, Map* map) {
  std::vector<std::pair<KeyframeId, std::shared_ptr<const Frame>>> unrolled;
  for (const auto& [id, keyframe] : map->keyframes()) {
    const Frame& frame = *keyframe.frame;
    if (!frame.velocity || std::abs(frame.readout_time - readout_time) < kMaxDifference) continue;
    unrolled.emplace_back(id,
                          std::make_shared<Frame>(Unroll(frame, *frame.velocity, readout_time)));
  }
  for (auto& [id, frame] : unrolled) map->SetFrame(id, std::move(frame));
}

}  // namespace msc_vo
