// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Poses world_from_cam as KITTI has them: the 12 numbers of the upper rows of the matrix per line,
/// without stamps.
std::string FormatKitti(const std::vector<TimedPose>& poses);

/// Poses world_from_cam in the columns of EuRoC's ground truth: nanoseconds, position, quaternion
/// with the scalar first.
std::string FormatEuroc(const std::vector<TimedPose>& poses);

}  // namespace msc_vo
