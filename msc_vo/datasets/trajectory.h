// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

// Reads a TUM trajectory: one pose per line, "time tx ty tz qx qy qz qw", camera in world, seconds
// and metres. Comments (#), blank lines, commas, tabs and CRLF are understood; quaternions are
// normalised. A pose below a comment "# not estimated" is marked as such. Poses with a nan or inf,
// which some programs write for a lost frame, are omitted and counted in `num_left_out` unless that
// is null. The result is in order of time. Throws std::runtime_error naming file and line if a line
// is anything else, or its quaternion is far from unit length.
std::vector<TimedPose> ReadTrajectory(const std::string& path, int* num_left_out = nullptr);

// The poses as a TUM trajectory that every tool reads: single spaces, none at the end of a line,
// times with six decimals, ascending and unique (the first pose of a stamp stays), unit quaternions
// with w >= 0. A comment line "# not estimated" stands above each pose that is not; other tools
// skip it.
std::string FormatTrajectory(std::vector<TimedPose> poses);

// FormatTrajectory into a file. Throws std::runtime_error if it cannot be written.
void WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses);

}  // namespace msc_vo
