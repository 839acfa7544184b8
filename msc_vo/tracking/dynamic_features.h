// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/map.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Returns the frame of `tracked`, which becomes a keyframe, with its dynamic features marked,
/// except inliers of the pose. Dynamic are
/// - those in a cell of a dynamic object (CellConsensus; lines: by their midpoint),
/// - those in free space: a keyframe around the reference keyframe looks through them,
/// - those of a connected surface of which nothing else is known, if more of its other features are
///   dynamic than static. The depth ranges of such a surface are removed.
/// Returns the frame itself if there are none, or `options` disable it.
std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const Map& map, const TrackedFrame& tracked);

}  // namespace msc_vo
