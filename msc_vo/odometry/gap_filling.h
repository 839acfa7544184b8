// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

// Gives every frame without an estimated pose (predicted or lost) the pose between its neighbours
// that have one, at constant velocity: once the camera was found again, that is a better guess than
// what was predicted before. Frames before the first estimate or after the last keep theirs.
// Statuses do not change. Frames are in order of time.
void FillGaps(std::vector<FrameResult>* frames);

}  // namespace msc_vo
