// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/time_unit.h"

namespace msc_vo {

/// The columns of a table of poses, from 0.
struct PoseColumns {
  std::optional<size_t> time;
  /// Nanoseconds after the whole seconds of `time`, as in ROS.
  std::optional<size_t> nanoseconds;
  std::optional<TimeUnit> unit;  ///< of the time, if it is named
  std::array<size_t, 3> position = {1, 2, 3};
  std::array<size_t, 4> quaternion = {4, 5, 6, 7};  ///< x y z w
  double metres = 1.0;                              ///< per unit of the position
  size_t num_names = 0;                             ///< columns that the header names

  /// The number of columns that a row must have.
  size_t MinColumns() const;
};

/// Finds the columns of time, position and quaternion by the names of a header:
/// "# timestamp tx ty tz qx qy qz qw", "#timestamp [ns], p_RS_R_x [m], ...",
/// "time,field.pose.position.x,...,field.pose.orientation.w", "t;PosX;...;RotW". Other columns may
/// stand between them. Returns std::nullopt if the line does not name each component once.
std::optional<PoseColumns> FindPoseColumns(const std::string& header);

}  // namespace msc_vo
