// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/landmark.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// Adds keyframes, landmarks and axes of the map whose first keyframe is `first_keyframe` to the
/// result; nothing if there is no such map.
void AddMap(const Mapper& mapper, KeyframeId first_keyframe, OdometryResult* result);

}  // namespace msc_vo
