// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/map/snapshot.h"

namespace msc_vo {

/// Whether the only keyframe of the map has no rolling-shutter compensation yet, because its
/// velocity is unknown until the next frame is tracked.
bool AwaitsCompensation(const MapSnapshot& snapshot);

/// Readout time (seconds) that frames are compensated with to be consistent with the map.
double CompensationReadoutTime(const MapSnapshot& snapshot);

/// The frame compensated for a rolling shutter with `readout_time` (seconds), with its planes at
/// its time stamp (SetDepthVelocity); the frame itself if the velocity is unknown.
std::shared_ptr<const Frame> CompensateFrame(std::shared_ptr<const Frame> frame,
                                             const std::optional<CameraVelocity>& velocity,
                                             double readout_time);

}  // namespace msc_vo
