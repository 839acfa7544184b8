// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Whether a point (metres, in the camera frame) lies in the free space of `frame`: all surfaces
/// around its pixel are farther by more than 5 %.
bool IsInFreeSpace(const Frame& frame, const Eigen::Vector3d& point);

/// Whether `frame` shows a surface at a point (metres, in its camera frame): the nearest that it
/// shows around its pixel is at that depth, to 5 %.
bool ShowsSurface(const Frame& frame, const Eigen::Vector3d& point);

/// Number of cells of the depth ranges of one frame whose surface lies in the free space of the
/// other. The larger number of both directions; 0 if the ranges of one are unknown.
///
/// In a static scene and at the correct pose, violations come only from depth errors. Occluded
/// surfaces are not counted.
int NumFreeSpaceViolations(const Frame& a, const Frame& b, const Rigid3& b_from_a);

}  // namespace msc_vo
