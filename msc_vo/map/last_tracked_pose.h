// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// The last frame that was tracked in a map, relative to a keyframe of the map.
struct LastTrackedPose {
  double timestamp = 0.0;  ///< seconds
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
};

}  // namespace msc_vo
