// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/axis_evidence.h"

namespace msc_vo {

/// Three orthogonal directions that most lines and surface normals of a scene are parallel to
/// (paper: MA_0..MA_2).
struct ManhattanAxes {
  /// The columns of its matrix are the axes in the frame of the evidence. Of the 24 rotations that
  /// differ in the order and signs of the axes, the one nearest to the identity.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d line_ratio = Eigen::Vector3d::Zero();    ///< fraction of all lines, per axis
  Eigen::Vector3d normal_ratio = Eigen::Vector3d::Zero();  ///< fraction of all normals, per axis
  double explained_ratio = 0.0;  ///< fraction of the weighted evidence, both kinds together
};

struct CoarseAxesOptions {
  /// Half angle, degrees, of the cone around an axis in which directions support it: 3 sigmas of a
  /// normal on noisy depth. Random axes explain 3 (1 - cos) = 1.6 % of random directions.
  double max_angle = 6.0;
  /// Largest standard deviation of a direction, degrees; less certain ones are ignored.
  double max_sigma = 4.0;
  /// Standard deviation of the Gaussian kernel of mean shift in the tangent plane, degrees:
  /// initially as wide as the cone, finally the scatter of normals on noisy depth.
  double first_bandwidth = 6.0;
  double last_bandwidth = 2.0;
  /// Smallest fraction of the evidence that the axes explain, of both kinds together and of each
  /// kind with enough directions. A majority excludes other axes with as much support.
  double min_explained_ratio = 0.5;
  /// Largest support of a rival hypothesis relative to the best one, counted over the evidence that
  /// they do not share: different axes may have one direction in common, as the walls of a house
  /// and its annexe share the vertical.
  double max_rival = 0.5;
  /// Smallest fraction of the normals (lines) in the cone of an axis that has surfaces (lines): ten
  /// times that of random directions.
  double min_axis_ratio = 0.05;
  /// Largest angle between an axis and the mean of its evidence, degrees. Two walls at 80 degrees
  /// fit into the cones of two axes with 5 degrees each; depth sensors bend surfaces by 1 degree.
  double max_misfit = 2.0;
  /// A contrario test: largest expected number of rotations, among those spanned by two of as many
  /// random directions, with at least as much support.
  double max_false_alarms = 1e-5;

  bool IsValid(std::string* error) const;
};

/// Estimates coarse Manhattan axes from the lines and surface normals of one view (paper: Manhattan
/// Axes Estimation, first stage; mean shift after Kim et al. 2018). Hypotheses are spanned by pairs
/// of modes of the evidence and refined by mean shift in the tangent planes of their axes, with
/// orthogonalisation at each step. The hypothesis with the highest density must pass every test of
/// the options, and must extend in three dimensions: surfaces across two axes or lines along all
/// three. A single rectangle shows lines along two axes and one normal, and may have any
/// orientation.
///
/// Returns std::nullopt if the view has no such axes. The result does not depend on the order of
/// the evidence, to the last bit. Throws std::invalid_argument on invalid options.
std::optional<ManhattanAxes> FindCoarseAxes(const CoarseAxesOptions& options,
                                            const std::vector<AxisEvidence>& lines,
                                            const std::vector<AxisEvidence>& normals);

}  // namespace msc_vo
