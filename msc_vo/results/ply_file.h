// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

// ASCII PLY files, which common viewers of point clouds open. Lengths are in metres.

/// Map points: vertices with x y z and the number of observations.
std::string FormatPointsPly(const std::vector<MapPoint>& points);

/// Map lines: edges between pairs of vertices. A vertex has x y z, the normal nx ny nz (unit vector
/// towards the observing cameras), a colour and the number of observations. Colours as in Fig. 1 of
/// the paper: red, green, blue by Manhattan axis, purple without axis, black outside of the last
/// local bundle adjustment.
std::string FormatLinesPly(const std::vector<MapLine>& lines);

/// Map planes: faces over vertices with x y z, the normal nx ny nz (towards the observing cameras),
/// a colour and the number of observations. Colours: red, green, blue by the Manhattan axis that
/// the normal is parallel to, grey without axis. Planes without a known extent are left out.
std::string FormatPlanesPly(const std::vector<MapPlane>& planes);

/// Line segments: edges between pairs of vertices with x y z.
std::string FormatEdgesPly(const std::vector<LineSegment3>& edges);

/// Read the files of FormatLinesPly and FormatEdgesPly. Elements and properties may be in any
/// order; unknown ones are ignored. Throw std::runtime_error naming file and line on any other
/// content, on a number that is not finite, and on a segment of zero length.
std::vector<EstimatedLine> ReadLinesPly(const std::string& path);
std::vector<LineSegment3> ReadEdgesPly(const std::string& path);

/// Reads the file of FormatPointsPly, with the same errors.
std::vector<MapPoint> ReadPointsPly(const std::string& path);

/// A line of a map and its colour, as red, green and blue.
struct ColoredEdge {
  LineSegment3 segment;  ///< metres, world
  std::array<uint8_t, 3> color = {};
};
/// Reads lines and colours of the file of FormatLinesPly, with the same errors.
std::vector<ColoredEdge> ReadColoredEdgesPly(const std::string& path);

/// A plane of a map as a convex polygon, and its colour.
struct ColoredPolygon {
  std::vector<Eigen::Vector3d> vertices;  ///< metres, world, counter-clockwise from the front
  std::array<uint8_t, 3> color = {};
};
/// Reads the file of FormatPlanesPly, with the same errors.
std::vector<ColoredPolygon> ReadColoredPolygonsPly(const std::string& path);

}  // namespace msc_vo
