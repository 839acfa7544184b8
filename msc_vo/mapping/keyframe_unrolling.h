// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

// Unrolls a keyframe anew when its velocity is known better. Nothing happens if it was removed.
void SetVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map);

// Unrolls the keyframes anew that were unrolled with another readout time (seconds): older ones
// than what is known of it, or taken before their velocity was known.
void UnrollKeyframes(double readout_time, Map* map);

}  // namespace msc_vo
