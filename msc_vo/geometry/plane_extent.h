// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/plane.h"

namespace msc_vo {

/// The part of a plane that has been observed: the vertices of a convex polygon on it, metres,
/// counter-clockwise seen from the front (the side of the normal); empty if it is unknown.
using PlaneExtent = std::vector<Eigen::Vector3d>;

/// Projection of a point onto a plane.
Eigen::Vector3d Project(const Plane& plane, const Eigen::Vector3d& point);

/// The convex hull of points that are projected onto a plane, with at most `max_vertices`. The
/// points are in the frame of the plane.
PlaneExtent ConvexHull(const Plane& plane, const std::vector<Eigen::Vector3d>& points,
                       size_t max_vertices);

/// Whether two extents, projected onto a plane, overlap, or an edge of one separates them by at
/// most `gap`, metres. False if one of them is unknown.
bool AreTouching(const Plane& plane, const PlaneExtent& a, const PlaneExtent& b, double gap);

/// The extent in the target frame of the transformation.
PlaneExtent operator*(const Rigid3& target_from_source, const PlaneExtent& extent);

}  // namespace msc_vo
