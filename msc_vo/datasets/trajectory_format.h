// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Formats of trajectory files, the same that the program evo reads. Files whose header names the
/// columns are kEuroc if they are comma-separated with the scalar of the quaternion first, or else
/// kTum.
enum class TrajectoryFormat {
  kTum,  ///< "time tx ty tz qx qy qz qw" in seconds and metres
  /// The 12 numbers of the upper rows of a 4x4 matrix, or all 16. No time stamps, unless there is a
  /// number in front.
  kKitti,
  kEuroc,  ///< comma-separated "nanoseconds, x, y, z, qw, qx, qy, qz"
};

/// "tum", "kitti", "euroc".
const char* ToString(TrajectoryFormat format);

/// Returns the names of all formats.
std::vector<std::string> TrajectoryFormatNames();

/// Returns the format with this name; none if there is no such format.
std::optional<TrajectoryFormat> TrajectoryFormatFromName(const std::string& name);

/// The contents of a trajectory file.
struct TrajectoryFile {
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool has_stamps = true;  ///< otherwise the time stamp of a pose is its row, from 0
  /// Unit of the stamps in the file, if a header or the format names it or ConvertToSeconds() has
  /// guessed it; then the stamps of `poses` are converted to seconds.
  std::optional<TimeUnit> unit;
  std::vector<TimedPose> poses;  ///< world_from_cam, in order of time
  /// Rows with nan or inf, or with a quaternion 0 0 0 0: other programs write them for lost frames.
  int num_left_out = 0;
  /// Their time stamps, in any order, as far as they are finite; their rows without time stamps.
  std::vector<double> times_left_out;

  /// Counts a row without a pose; `time` is its time stamp.
  void LeaveOut(double time);
  /// "2 rows with nan, inf or a zero quaternion are left out"; empty if none is.
  std::string DescribeLeftOut() const;
  /// Says that and why there are no poses; empty if there are.
  std::string DescribeLack() const;
};

/// Thrown for a file that is no trajectory, while a damaged line in one is a std::runtime_error:
/// most of its rows are no poses, or all are written in a way that makes them useless.
class NotATrajectory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a trajectory in the given format. Without one, a header decides which columns hold time,
/// position and quaternion (FindPoseColumns()). Without a header, rows of 12 or 16 numbers with a
/// rotation matrix are KITTI, comma-separated rows whose stamps are nanoseconds are EuRoC, and all
/// others TUM; all with or without a number in front; further columns are ignored. Rows of seven
/// numbers have no time stamp. Throws std::runtime_error naming file, line and fix if a row does
/// not fit; NotATrajectory if most do not, if there is a rotation matrix or quaternion in other
/// columns, if numbers have decimal commas, or if the stamps lost their last digits.
TrajectoryFile ReadTrajectoryFile(const std::string& path,
                                  std::optional<TrajectoryFormat> format = std::nullopt);

/// Converts the stamps of two trajectories of the same recording to seconds, unless a file says its
/// unit. Adds a warning for each that is converted. The paths are those of the files.
void ConvertToSeconds(const std::string& reference_path, const std::string& estimate_path,
                      TrajectoryFile* reference, TrajectoryFile* estimate,
                      std::vector<std::string>* warnings);

/// Gives a trajectory without time stamps those of the other one, pose by pose; without any, both
/// keep their rows. Throws std::runtime_error, naming both files, if the numbers of poses differ.
/// Does nothing if both have time stamps. The paths are those of the files, for messages.
void ShareStamps(const std::string& reference_path, const std::string& estimate_path,
                 TrajectoryFile* reference, TrajectoryFile* estimate);

/// The comment above a pose in a trajectory file, "segment 2, world 0, not estimated"; empty if the
/// pose needs none. `segment` and `world` are those of the pose before it.
std::string FormatPoseComment(const TimedPose& pose, int segment, int world);

/// Reads the comment above a pose, whose segment and world are those of the pose before it. Other
/// comments have no effect.
void ReadPoseComment(const std::string& comment, TimedPose* pose);

}  // namespace msc_vo
