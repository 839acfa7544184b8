// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/structure/internal/axes_evidence.h"

namespace msc_vo {

/// Largest angle (radians) between an axis of `a` and the nearest axis of `b`; columns are axes
/// whose order and sign have no meaning.
double AngleBetweenAxes(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// Hypotheses of Manhattan axes: rotations spanned by pairs of perpendicular modes of the evidence,
/// each refined by mean shift.
std::vector<Eigen::Matrix3d> FindAxesHypotheses(const DirectionEvidence& evidence);

}  // namespace msc_vo
