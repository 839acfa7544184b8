// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
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
  double explained_ratio = 0.0;  ///< fraction of the weighted evidence, both kinds together
};

/// Estimates coarse Manhattan axes from the lines and surface normals of one view (paper: Manhattan
/// Axes Estimation, first stage; mean shift after Kim et al. 2018). Hypotheses are spanned by pairs
/// of modes of the evidence and refined by mean shift in the tangent planes of their axes, with
/// orthogonalisation at each step. The hypothesis with the highest density must pass every test of
/// the internal axes_gates.h, and must extend in three dimensions: surfaces across two axes or
/// lines along all three. A single rectangle shows lines along two axes and one normal, and may
/// have any orientation.
///
/// Returns std::nullopt if the view has no such axes. The result does not depend on the order of
/// the evidence, to the last bit.
std::optional<ManhattanAxes> FindCoarseAxes(const std::vector<AxisEvidence>& lines,
                                            const std::vector<AxisEvidence>& normals);

}  // namespace msc_vo
