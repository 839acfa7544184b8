// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/axis_evidence.h"
#include "msc_vo/structure/direction_modes.h"

namespace msc_vo {

/// The directions of a view that coarse axes are estimated from: lines first, then surface normals.
struct DirectionEvidence {
  std::vector<WeightedDirection> all;  ///< weights sum to 1
  size_t num_lines = 0;

  size_t NumNormals() const { return all.size() - num_lines; }
  bool IsLine(size_t i) const { return i < num_lines; }
};

/// Half angle, radians, of the cone around an axis in which directions support it: 3 sigmas of a
/// normal on noisy depth. Random axes explain 3 (1 - cos) = 1.6 % of random directions.
constexpr double kAxisCone = DegreesToRadians(6.0);
/// Standard deviation of the Gaussian kernel of mean shift in the tangent plane, radians: initially
/// as wide as the cone, finally the scatter of normals on noisy depth.
constexpr double kFirstBandwidth = kAxisCone;
constexpr double kLastBandwidth = DegreesToRadians(2.0);
/// Largest standard deviation of a direction, radians; less certain ones are ignored, because a
/// third of them or more lies outside the cone of their axis.
constexpr double kMaxEvidenceSigma = DegreesToRadians(4.0);
/// Number of lines and of normals from which a kind has its full weight: the fraction of 20
/// directions in a cone has a standard deviation of about 0.1.
constexpr double kFullWeightLines = 20.0;
constexpr double kFullWeightNormals = 200.0;

/// Selects the directions that are certain enough and weights both kinds by their number. The
/// result does not depend on the order of the input.
DirectionEvidence GatherEvidence(const std::vector<AxisEvidence>& lines,
                                 const std::vector<AxisEvidence>& normals);

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
