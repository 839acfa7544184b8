// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/plane_map.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/structure/scene_axes.h"

namespace msc_vo {

/// Name of a submap and of its world: the number of the segment that began it. A map that replaces
/// a discarded one takes over its number, as the segment does.
using SubMapId = int;
constexpr SubMapId kNoSubMap = -1;

/// A map in a world of its own, with what is estimated from its windows.
struct SubMap {
  SubMapId id = kNoSubMap;
  Map map;
  SceneAxes axes;        ///< of its world
  NoiseEstimator noise;  ///< of the measurements in it
  PlaneMap planes;
};

}  // namespace msc_vo
