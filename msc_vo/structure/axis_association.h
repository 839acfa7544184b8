// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/axis_evidence.h"

namespace msc_vo {

struct AxisAssociationOptions {
  // A line belongs to an axis below so many sigmas of line and axes together: the 99 % quantile of
  // the length of an error with two components.
  double max_sigmas = 3.035;
  // And below this angle, radians. Random directions are that near to an axis in 1 % of all cases.
  double max_angle = DegreesToRadians(5.0);
  // A line with a larger sigma than this passes the angle by chance rather than by its direction,
  // and is left alone, radians.
  double max_sigma = DegreesToRadians(5.0);

  bool IsValid(std::string* error) const;
};

// Index 0..2 of the axis that a line is parallel to (paper: Manhattan Axes Association); none if it
// is parallel to none or too uncertain to tell. `rotation` has the axes as columns, in the frame of
// the line's direction, and `rotation_sigma` (radians) about each of its three components. The
// other two axes are 85 degrees away at least, so that the nearest one is never in doubt. Throws
// std::invalid_argument on options that are not valid.
std::optional<int> AssociateAxis(const AxisAssociationOptions& options,
                                 const Eigen::Quaterniond& rotation, double rotation_sigma,
                                 const AxisEvidence& line);

}  // namespace msc_vo
