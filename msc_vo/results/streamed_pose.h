// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

/// Form of the poses that `replay --stdout-poses` prints.
enum class StreamedPoseForm { kText, kJson };

/// Formats a frame as a line, with its end.
///
/// Text: "time x y z qx qy qz qw sx sy sz srx sry srz status world": world_from_cam as in a TUM
/// trajectory; standard deviations of the camera's position (metres) and of its rotation vector
/// (radians), both in the camera frame,
/// relative to the map nearby; the status; the number of the world. Numbers that are not
/// known are nan: all of a frame without a pose, the deviations of a pose that is a definition.
///
/// JSON: an object with the same values, the standard deviations relative to the origin of the
/// world (FrameResult::world_covariance), the pose by odometry alone with its own and, where the
/// world changes, the transform.
std::string FormatStreamedPose(const FrameResult& frame, StreamedPoseForm form);

}  // namespace msc_vo
