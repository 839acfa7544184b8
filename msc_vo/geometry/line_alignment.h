// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// How two figures of the same scene, measured in two frames, may differ and still be the same.
struct AlignmentTolerance {
  double angle = 0.0;     ///< radians, between angles
  double distance = 0.0;  ///< metres, between distances
};

/// Returns the rigid transform target_from_source that aligns two directed infinite lines: the
/// directions as well as their angle allows, the positions by least squares. The end points of the
/// segments need not correspond. Returns std::nullopt if the lines of a pair are almost parallel,
/// which leaves the transform undetermined, or if their angle or distance differs between source
/// and target by more than the tolerance.
std::optional<Rigid3> AlignLines(const std::array<LineSegment3, 2>& source,
                                 const std::array<LineSegment3, 2>& target,
                                 const AlignmentTolerance& tolerance);

/// The same for one directed line and a point beside it. Returns std::nullopt if the point is
/// within ten tolerances of the line or its distance to the line differs by more than the
/// tolerance.
std::optional<Rigid3> AlignLineAndPoint(const LineSegment3& source_line,
                                        const Eigen::Vector3d& source_point,
                                        const LineSegment3& target_line,
                                        const Eigen::Vector3d& target_point,
                                        const AlignmentTolerance& tolerance);

}  // namespace msc_vo
