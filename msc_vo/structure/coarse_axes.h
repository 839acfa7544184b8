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

// Three orthogonal directions that most lines and surfaces of a scene keep to (paper: MA_0..MA_2).
struct ManhattanAxes {
  // Its matrix has the axes as columns, in the frame of the evidence. Of the 24 rotations that
  // differ in order and signs of the axes only, the one nearest to the identity.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d line_ratio = Eigen::Vector3d::Zero();    // of all lines, per axis
  Eigen::Vector3d normal_ratio = Eigen::Vector3d::Zero();  // of all normals, per axis
  double share = 0.0;  // of the evidence that the axes explain; both kinds together
};

struct CoarseAxesOptions {
  // Half angle of the cone around an axis in which evidence belongs to it, radians: 3 sigmas of
  // the usual normal on noisy depth. Random axes explain 3 (1 - cos) = 1.6 % of random directions.
  double max_angle = DegreesToRadians(6.0);
  // Evidence with a larger sigma than this cannot be told to lie in the cone or not, radians.
  double max_sigma = DegreesToRadians(4.0);
  // Standard deviation of the Gaussian kernel in the tangent plane, radians: at first as wide as
  // the cone, since candidates are rough; at last the scatter of normals on noisy depth.
  double first_bandwidth = DegreesToRadians(6.0);
  double last_bandwidth = DegreesToRadians(2.0);
  // Of all evidence, and of the lines and of the normals where there are enough of them. A
  // majority: what is left cannot explain as much by other axes.
  double min_explained_ratio = 0.5;
  // Axes that differ may share one of the directions, as the walls of a house and of its annexe
  // share the vertical. Of what is not common, others may explain half as much at most.
  double max_rival = 0.5;
  // Share of the normals (of the lines) from which on an axis counts as having surfaces (lines):
  // ten times what chance puts into its cone.
  double min_axis_ratio = 0.05;
  // Mean of the evidence of an axis off that axis, radians. Two walls at 80 degrees fit into the
  // cones of two axes, but each is off by 5 degrees. Depth sensors bend surfaces by 1 degree.
  double max_misfit = DegreesToRadians(2.0);
  // Expected number of frames among all frames that are spanned by two members of random evidence
  // that would be supported as well (an a contrario test). One in a hundred thousand calls.
  double max_false_alarms = 1e-5;

  bool IsValid(std::string* error) const;
};

// Manhattan axes from the lines and surface normals of one view (paper: Manhattan Axes Estimation,
// first stage; mean shift after Kim et al. 2018). Candidates are spanned by pairs of modes of the
// evidence; each climbs by mean shift in the tangent planes of its axes and is made orthogonal
// again at each step; the one that explains most must pass every gate of the options, and must be
// seen as a volume: surfaces across two axes or lines along all three. A single rectangle, however
// rich, shows lines along two axes and one normal, and could hang at any angle.
//
// std::nullopt if the view has no such axes. The answer does not depend on the order of the
// evidence, to the last bit. Throws std::invalid_argument on options that are not valid.
std::optional<ManhattanAxes> FindCoarseAxes(const CoarseAxesOptions& options,
                                            const std::vector<AxisEvidence>& lines,
                                            const std::vector<AxisEvidence>& normals);

}  // namespace msc_vo
