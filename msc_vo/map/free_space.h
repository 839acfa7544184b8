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

/// How the surfaces of one frame agree with those of another: cells of its depth ranges.
struct SurfaceAgreement {
  int num_same = 0;        ///< whose surface the other frame shows
  int num_violations = 0;  ///< whose surface lies in the free space of the other frame
};

/// Compares the surfaces of frame `a` with those of `b`. Occluded ones are not counted, and none if
/// the depth ranges of a frame are unknown. In a static scene and at the correct pose, violations
/// come only from depth errors.
SurfaceAgreement CompareSurfaces(const Frame& a, const Frame& b, const Rigid3& b_from_a);

/// The larger number of violations of the two directions.
int NumFreeSpaceViolations(const Frame& a, const Frame& b, const Rigid3& b_from_a);

}  // namespace msc_vo
