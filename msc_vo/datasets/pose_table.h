// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/datasets/column_names.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

/// Whether the components of a quaternion, in any order, have unit length up to their rounding.
bool IsUnitQuaternion(const Eigen::Vector4d& components);

/// The rows of a trajectory file, and the columns that its header names.
struct PoseRows {
  std::vector<TextLine> rows;
  std::optional<PoseColumns> named;  ///< none if there is no header that names columns
};

/// Reads the rows of a file and its header, which may be a comment. Throws std::runtime_error
/// naming file and line if the file begins with lines that are neither rows nor comments, none of
/// which names columns; with `any_header`, such lines are skipped.
PoseRows ReadPoseRows(const std::string& path, bool any_header);

/// Reads rows with a position and a quaternion each. The columns are those that are named, or that
/// of the format, or else those in which all quaternions have unit length: the first eight, or the
/// next ones after a column with the number of the row. Throws std::runtime_error naming file, line
/// and fix if a row does not fit.
TrajectoryFile ReadPoseTable(PoseRows rows, std::optional<TrajectoryFormat> format);

}  // namespace msc_vo
