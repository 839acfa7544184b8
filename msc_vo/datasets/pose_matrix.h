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

// Reads the numbers of a text file, row by row, as a matrix. Numbers may be "nan" or "inf".
// Throws std::runtime_error, naming file and line, if the file does not hold rows x columns
// numbers.
Eigen::MatrixXd ReadMatrix(const std::string& path, int rows, int columns);

// The transform of a 4x4 matrix [R t; 0 1]; R is taken to the nearest rotation. None if a number is
// not finite or R is no rotation by more than rounding: how data sets mark a lost pose.
std::optional<Rigid3> RigidFromMatrix(const Eigen::Matrix4d& matrix);

// The ground truth of a layout with one file per image, a 4 x 4 matrix camera in world. Files that
// do not exist are passed over; poses that are none are counted in a warning.
void ReadPoseFiles(const std::function<std::string(const SequenceEntry&)>& pose_path,
                   SequenceIndex* index);

}  // namespace msc_vo
