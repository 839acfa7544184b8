// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// The result of a tracked frame of segment `segment`, without the measurements of its image and
/// without the times of other stages than tracking.
FrameResult MakeResult(const TrackedFrame& tracked, int segment);

}  // namespace msc_vo
