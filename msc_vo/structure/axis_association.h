// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/axis_evidence.h"
#include "msc_vo/structure/deviation_estimator.h"
#include "msc_vo/structure/direction_estimate.h"

namespace msc_vo {

/// Largest angle between a line and its axis, and largest standard deviation of the line's
/// direction, radians. Random directions are within 5 degrees of an axis with a probability of 1 %;
/// less certain ones would pass the test of the angle by chance.
constexpr double kMaxAxisAngle = DegreesToRadians(5.0);
/// Largest angle between a line and its axis, in sigmas of both together: square root of the 99 %
/// quantile of chi-square with two degrees of freedom.
constexpr double kMaxAxisSigmas = 3.035;

/// Returns the index 0..2 of the axis that a line is parallel to (paper: Manhattan Axes
/// Association); std::nullopt if it is parallel to none, or too uncertain. The columns of
/// `rotation` are the axes in the frame of the line's direction; `rotation_sigma` (radians) is the
/// standard deviation of each component of its rotation vector.
std::optional<int> AssociateAxis(const Eigen::Quaterniond& rotation, double rotation_sigma,
                                 const AxisEvidence& line);

/// A line that is near to an axis, and its angle to it.
struct AxisCandidate {
  int axis = 0;
  DirectionDeviation deviation;
};

/// Returns the axis that is within `max_angle` (radians) of a line's direction, if that is certain
/// to the same angle. The columns of `axes` are the axes in the world; `axes_sigma`: radians, part
/// of the covariance of the angle.
std::optional<AxisCandidate> NearestAxis(double max_angle, const Eigen::Matrix3d& axes,
                                         double axes_sigma, const DirectionEstimate& line);

}  // namespace msc_vo
