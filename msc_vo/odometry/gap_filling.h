// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/segment_log.h"

namespace msc_vo {

/// Replaces the pose of every frame without an estimate (predicted, lost, dropped, unreadable) by
/// interpolation between its neighbours with one, at constant velocity: more accurate than the
/// prediction from the frames before the gap. A pose that pose factors determined counts as an
/// estimate. Frames before the first estimate or after the last one, between segments whose worlds
/// are not joined, and statuses, do not change. Frames are in order of time.
void FillGaps(const std::vector<Segment>& segments, std::vector<FrameResult>* frames);

}  // namespace msc_vo
