// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Formats of trajectory files, the same that the program evo reads.
enum class TrajectoryFormat {
  kTum,    ///< "time tx ty tz qx qy qz qw" in seconds and metres
  kKitti,  ///< the 12 numbers of the upper rows of a 4x4 matrix, row by row; no time stamps
  kEuroc,  ///< comma-separated "nanoseconds, x, y, z, qw, qx, qy, qz", more columns may follow
};

/// "tum", "kitti", "euroc".
const char* ToString(TrajectoryFormat format);

/// Returns the names of all formats.
std::vector<std::string> TrajectoryFormatNames();

/// Returns the format with this name; none if there is no such format.
std::optional<TrajectoryFormat> TrajectoryFormatFromName(const std::string& name);

/// Returns the format of a file, which follows from its first row and the comment above it: 12
/// numbers are KITTI; comma-separated rows are EuRoC if the header names nanoseconds or qw before
/// qx, if there are more than 8 columns, or if the first number is a date in nanoseconds;
/// everything else is TUM. Throws std::runtime_error, naming the file, if it cannot be read.
TrajectoryFormat DetectTrajectoryFormat(const std::string& path);

/// The contents of a trajectory file.
struct TrajectoryFile {
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool has_stamps = true;  ///< otherwise the time stamp of a pose is its row, from 0
  /// World_from_cam, in order of time. Stamps of TUM files are not converted if they are in another
  /// unit than seconds.
  std::vector<TimedPose> poses;
  int num_left_out = 0;  ///< rows with nan or inf
};

/// Reads a trajectory in the given format, which is detected if it is none. Throws
/// std::runtime_error naming file, line and fix if a row does not fit.
TrajectoryFile ReadTrajectoryFile(const std::string& path,
                                  std::optional<TrajectoryFormat> format = std::nullopt);

/// Gives a trajectory without time stamps those of the other one, pose by pose; without any, both
/// keep their rows. Throws std::runtime_error, naming both files, if the numbers of poses differ.
/// Does nothing if both have time stamps. The paths are those of the files, for messages.
void ShareStamps(const std::string& reference_path, const std::string& estimate_path,
                 TrajectoryFile* reference, TrajectoryFile* estimate);

}  // namespace msc_vo
