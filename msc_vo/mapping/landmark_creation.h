// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/culling.h"

namespace msc_vo {

/// Creates a landmark on probation from every feature of `keyframe` that has a depth and no
/// landmark, except on dynamic objects.
void CreateLandmarks(KeyframeId keyframe, Probation* probation, Map* map);

}  // namespace msc_vo
