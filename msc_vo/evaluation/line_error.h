// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/evaluation/error_statistics.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// A line of the estimated map.
struct EstimatedLine {
  LineSegment3 segment;  ///< metres, world of the estimate
  int num_observations = 0;
  /// Unit vector: mean direction from the observing cameras to the line.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
};

/// Errors of map lines with respect to the edges of the scene. Read the errors together with the
/// counts: a map that dropped its bad lines has small errors.
struct LineError {
  int num_lines = 0;        ///< lines of the map
  int num_counted = 0;      ///< lines with enough observations and length
  int num_matched = 0;      ///< counted lines that are matched with an edge
  int num_edges = 0;        ///< edges of the scene, visible or not
  int num_edges_found = 0;  ///< edges that are matched with at least one line

  ErrorStatistics direction;  ///< radians, angle between a line and its edge
  ErrorStatistics distance;   ///< metres, from the line's midpoint to the edge's infinite line
  ErrorStatistics across;     ///< metres, the part of `distance` that the image measures
};

/// Compares map lines with the true edges of a scene. Lines with fewer than three observations or
/// shorter than 0.2 m are skipped. Each line is matched with the edge that has the smallest sum of
/// squared offsets, each relative to its bound; edges outside of the bounds are excluded. Bounds
/// across the plane through the edge and the viewing direction, which the image measures: 0.01 m
/// and 3 degrees; in that plane, which depth measures: 0.1 m and 27 degrees in total. The midpoint
/// may be 0.1 m beyond the end of the edge. On ties the first edge is taken. Several lines may be
/// matched with one edge, because a map may hold an edge in parts. The bounds are tighter across
/// the viewing direction, so neighbouring edges are distinguished by the image, which is accurate,
/// and not by depth, whose error is to be measured. Throws std::invalid_argument on edges without
/// length.
LineError EvaluateLines(const std::vector<LineSegment3>& edges,
                        const std::vector<EstimatedLine>& lines,
                        const Rigid3& reference_from_estimate);

}  // namespace msc_vo
