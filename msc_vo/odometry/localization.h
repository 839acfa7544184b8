// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// The number of worlds of earlier sessions (Odometry::SetMap()): 0, ..., n - 1.
int NumEarlierWorlds(const OdometryResult& result);

/// Index of the first frame whose pose is in the world of an earlier session: the one that
/// completed the join of both maps. std::nullopt if there is none.
std::optional<int> FirstLocalizedFrame(const OdometryResult& result);

/// Keeps the poses in worlds of earlier sessions, from the first localised frame of each segment
/// on, for results that are about the place in the map. All other frames become lost, and belong to
/// the segment before.
void KeepLocalizedPoses(std::vector<Segment>* segments, std::vector<FrameResult>* frames);

/// The same for a frame as Odometry::Process() returns it, before it is known whether and where the
/// run is found later. `num_earlier_worlds`: submaps of Odometry::SetMap().
FrameResult KeepLocalizedPose(int num_earlier_worlds, FrameResult frame);

}  // namespace msc_vo
