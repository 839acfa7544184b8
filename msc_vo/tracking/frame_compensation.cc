// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/frame_compensation.h"

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

bool AwaitsCompensation(const MapSnapshot& snapshot) {
  const Map::KeyframeTable& keyframes = snapshot.map.keyframes();
  return keyframes.size() == 1 && !keyframes.back().second.frame->velocity;
}

double CompensationReadoutTime(const MapSnapshot& snapshot) {
  return AwaitsCompensation(snapshot) ? 0.0 : snapshot.readout_time;
}

std::shared_ptr<const Frame> CompensateFrame(std::shared_ptr<const Frame> frame,
                                             const std::optional<CameraVelocity>& velocity,
                                             double readout_time) {
  if (!velocity) return frame;
  auto compensated =
      std::make_shared<Frame>(CompensateRollingShutter(*frame, *velocity, readout_time));
  SetDepthVelocity(*velocity, compensated.get());
  return compensated;
}

}  // namespace msc_vo
