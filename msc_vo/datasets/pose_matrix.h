// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Reads a text file with rows x columns numbers as a matrix, row by row; the last row of a 4x4
/// matrix may be missing and then is 0 0 0 1. Numbers may be "nan" or "inf". Throws
/// std::runtime_error, naming the file, if the count of numbers differs or a field is not a number.
Eigen::MatrixXd ReadMatrix(const std::string& path, int rows, int columns);

/// Converts a 4x4 matrix [R t; 0 1] to a transform with the rotation nearest to R. None if a number
/// is not finite, R is not a rotation up to rounding, or the last row is another one: data sets
/// mark lost poses this way.
std::optional<Rigid3> RigidFromMatrix(const Eigen::Matrix4d& matrix);

/// As RigidFromMatrix(). Throws std::runtime_error, naming the place of the matrix in a file, if
/// only its transpose is a pose.
std::optional<Rigid3> PoseFromMatrix(const Eigen::Matrix4d& matrix, const std::string& place);

/// Reads the ground truth of a layout with one file per image, which contains the 4x4 matrix
/// world_from_cam. Missing files are ignored. Adds a warning with the number of invalid poses.
/// Throws std::runtime_error, naming the file, if a matrix is transposed.
void ReadPoseFiles(const std::function<std::string(const SequenceEntry&)>& pose_path,
                   SequenceIndex* index);

}  // namespace msc_vo
