// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

// Unrolls a keyframe anew when its velocity is known better. Nothing happens if it was removed.
void SetVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map);

// The frame unrolled with a readout time (seconds), if its velocity is known; as it is if it was
// unrolled with that before.
std::shared_ptr<const Frame> Compensated(std::shared_ptr<const Frame> frame, double readout_time);

// Unrolls the keyframes anew that were unrolled with another readout time: older ones than what is
// known of it, or taken before their velocity was known. Landmarks that nothing else has seen go
// where the keyframe has them then, so that frames find them there before a window moves them.
void CompensateKeyframes(double readout_time, Map* map);

}  // namespace msc_vo
