// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// The comment above a pose in a trajectory file, "segment 2, world 0, not estimated"; empty if the
/// pose needs none. `segment` and `world` are those of the pose before it.
std::string FormatPoseComment(const TimedPose& pose, int segment, int world);

/// Reads the comment above a pose, whose segment and world are those of the pose before it. Other
/// comments have no effect.
void ReadPoseComment(const std::string& comment, TimedPose* pose);

}  // namespace msc_vo
