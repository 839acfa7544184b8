// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace msc_vo {

/// The vertices of a convex polygon, counter-clockwise; empty if there is none.
using ConvexPolygon = std::vector<Eigen::Vector2d>;

/// The convex hull of points, without vertices on its edges. Empty if all points lie on one line.
ConvexPolygon ConvexHull(std::vector<Eigen::Vector2d> points);

/// Removes vertices until at most `max_vertices` (three or more) are left, each time the one whose
/// removal costs the least area: the result lies within the polygon.
void Simplify(size_t max_vertices, ConvexPolygon* polygon);

/// Whether two polygons overlap, or an edge of one separates them by at most `gap`. False if one is
/// empty.
bool AreTouching(const ConvexPolygon& a, const ConvexPolygon& b, double gap);

}  // namespace msc_vo
