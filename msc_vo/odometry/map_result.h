// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/mapping/mapper.h"
#include "msc_vo/mapping/plane_map.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/structure/scene_axes.h"

namespace msc_vo {

/// Adds keyframes, landmarks and axes of a submap to the result, whose frames are known; nothing if
/// there is no such submap.
void AddMap(const Mapper& mapper, SubMapId submap_id, OdometryResult* result);

/// The planes of a map in its world, with the axes that they are normal to, if axes are known.
std::vector<MapPlane> MakeMapPlanes(const PlaneMap& planes, const Map& map,
                                    const std::optional<AxesEstimate>& axes);

/// Adds the keyframes of the earlier `sessions` to the result, whose segments are known, by world.
void AddEarlierSessions(const Atlas& atlas, const std::vector<MapSession>& sessions,
                        OdometryResult* result);

}  // namespace msc_vo
