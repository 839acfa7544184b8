// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Whether `frame` looks through a point (metres, in its camera frame): all that it shows around
/// its pixel is farther by more than 5 %.
bool LooksThrough(const Frame& frame, const Eigen::Vector3d& point);

/// Whether `frame` shows a surface at a point (metres, in its camera frame): the nearest that it
/// shows around its pixel is at that depth, to 5 %.
bool ShowsSurface(const Frame& frame, const Eigen::Vector3d& point);

/// Number of cells of the depth ranges of one of both frames whose surface the other one looks
/// through. The larger number of both directions; 0 if the ranges of one are unknown.
///
/// In a static scene no surface is looked through from the right pose but for errors of depth.
/// Surfaces that are hidden by nearer ones tell nothing.
int NumFreeSpaceViolations(const Frame& a, const Frame& b, const Rigid3& b_from_a);

}  // namespace msc_vo
