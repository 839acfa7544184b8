// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace msc_vo {

/// Observed directions of lines that are associated with Manhattan axes.
struct ManhattanAxesData {
  struct Observation {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, world; its sign has no meaning
    int axis = 0;  ///< 0, 1 or 2: the column of world_from_manhattan that it belongs to
    /// Normal of the interpretation plane: unit, world, perpendicular to the direction.
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    double sigma = 0.01;         ///< radians, of the direction's angle in the interpretation plane
    double normal_sigma = 0.01;  ///< radians, out of it
    bool inlier = true;          ///< out
  };
  Eigen::Quaterniond world_from_manhattan = Eigen::Quaterniond::Identity();  ///< in: coarse; out
  std::vector<Observation> observations;
};

struct ManhattanAxesSummary {
  /// False if there are too few inliers, or all belong to one axis, which leaves the rotation about
  /// it undetermined. The axes are then unchanged.
  bool usable = false;
  int num_inliers = 0;
  /// Covariance of the rotation vector w of Exp(w) q in the world, radians^2: the inverse of J^T J,
  /// scaled by the mean squared residual of the inliers where that exceeds one. Zero if not usable.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Refines the Manhattan axes over all observed directions (paper: Manhattan Axes Estimation, last
/// equation), as one rotation on SO(3), and classifies the observations.
/// Throws std::invalid_argument, naming the observation, on a direction that is not unit, an axis
/// that is not 0, 1 or 2, a sigma <= 0, or on a start that is not unit.
ManhattanAxesSummary RefineManhattanAxes(ManhattanAxesData* data);

}  // namespace msc_vo
