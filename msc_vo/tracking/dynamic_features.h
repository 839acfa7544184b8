// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

// The frame of `tracked` with a mark on every feature in a part of the image that moves (a line:
// with its middle), but for those whose match agrees with the pose. The frame itself if no part
// moves. options: those that the parts are of.
std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const TrackedFrame& tracked);

}  // namespace msc_vo
