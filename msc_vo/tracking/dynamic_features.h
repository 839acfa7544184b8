// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Returns the frame of `tracked` with every feature in a cell of a dynamic object marked (lines:
/// by their midpoint), except inliers of the pose. Returns the frame itself if there are no such
/// cells.
std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const TrackedFrame& tracked);

}  // namespace msc_vo
