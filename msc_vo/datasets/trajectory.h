// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Reads a trajectory with one pose world_from_cam per line in metres, "time tx ty tz qx qy qz qw",
/// or in the columns that a header names (ReadTrajectoryFile()). A comment "# segment 2, world 0"
/// is the beginning of another segment. Accepts comments (#), blank lines, commas, tabs and CRLF;
/// normalises quaternions. A pose below a comment "# not estimated" is marked as such. Poses with
/// nan or inf, which some programs write for lost frames, are left out and counted in
/// `num_left_out` unless that is null. The result is in order of time; poses of the same time
/// remain in order. Throws std::runtime_error naming file and line if a line does not fit or its
/// quaternion is far from unit length.
std::vector<TimedPose> ReadTrajectory(const std::string& path, int* num_left_out = nullptr);

/// Formats poses as a TUM trajectory that other tools can read: fields separated by single spaces,
/// times with six decimals, ascending and unique (the first pose of a stamp is kept), unit
/// quaternions with w >= 0. The comment "# not estimated", which other tools skip, precedes each
/// pose that is not estimated, and "# segment 2, world 0" each pose whose segment or world is not
/// that of the pose before it. `before`: the last pose of the text that this one continues.
std::string FormatTrajectory(std::vector<TimedPose> poses, const TimedPose& before = {});

/// Writes the result of FormatTrajectory() to a file. Throws std::runtime_error, naming the file,
/// if it cannot be written.
void WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses);

}  // namespace msc_vo
