// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

// PLY files as text, which every viewer of point clouds opens; metres.

/// The points of a map: x y z, number of observations.
std::string FormatPointsPly(const std::vector<MapPoint>& points);

/// The lines of a map as edges between pairs of vertices: x y z, the normal nx ny nz (unit vector
/// towards the cameras that saw the line), colour, number of observations.
std::string FormatLinesPly(const std::vector<MapLine>& lines);

/// Line segments as edges between pairs of vertices: x y z.
std::string FormatEdgesPly(const std::vector<LineSegment3>& edges);

/// What the two above have written; elements and properties may come in any order, and others
/// besides. Throw std::runtime_error naming file and line if a file is anything else, has a number
/// that is not finite, or a segment without length.
std::vector<EstimatedLine> ReadLinesPly(const std::string& path);
std::vector<LineSegment3> ReadEdgesPly(const std::string& path);

}  // namespace msc_vo
