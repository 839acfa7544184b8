// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/structure/internal/axes_evidence.h"

namespace msc_vo {

/// Support of a hypothesis of Manhattan axes in the evidence of a view.
struct ScoredAxes {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d num_lines = Eigen::Vector3d::Zero();    ///< in the cone of each axis
  Eigen::Vector3d num_normals = Eigen::Vector3d::Zero();  ///< in the cone of each axis
  /// Angle between the mean direction in the cone of each axis and the axis, radians.
  Eigen::Vector3d misfit = Eigen::Vector3d::Zero();
  double explained_ratio = 0.0;  ///< total weight of the evidence in the three cones
  double density = 0.0;          ///< weights under the last kernel: the objective of mean shift
};

/// Counts the evidence in the cones around `axes`, the columns of a rotation in its frame.
ScoredAxes ScoreAxes(const DirectionEvidence& evidence, const Eigen::Matrix3d& axes);

}  // namespace msc_vo
