// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// One pose of a trajectory, as it stands in a trajectory file: camera in world.
struct TimedPose {
  double timestamp = 0.0;  // seconds
  Rigid3 world_from_cam;
  // False: predicted or interpolated in time, not measured from the image of this time.
  bool is_estimated = true;
};

}  // namespace msc_vo
