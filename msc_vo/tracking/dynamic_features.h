// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/map.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Returns the frame of `tracked`, which becomes a keyframe, with its dynamic features marked,
/// except inliers of the pose. Dynamic are
/// - features in a cell of a dynamic object (CellConsensus; lines: by their midpoint);
/// - features with depth in free space: more keyframes look through them (IsInFreeSpace) than show
///   a surface there, among up to 21, the reference keyframe, its covisible and the newest ones;
/// - features of which this is not known, on a connected surface with at least three dynamic
///   features and twice as many as static ones. The depth ranges of such a surface are removed.
/// Returns the frame itself if there are none, or `options` disable it.
std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const Map& map, const TrackedFrame& tracked);

}  // namespace msc_vo
