// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/evaluation/error_statistics.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Which map lines are evaluated, and how far a line may be from its edge. Offsets are split into a
/// part across the plane through the edge and the viewing direction, which the image measures, and
/// a part in that plane, which depth measures.
struct LineEvaluationOptions {
  /// Lines with fewer observations are skipped: no third view has confirmed the match of the first
  /// two.
  int min_observations = 3;
  /// Shorter lines are skipped, metres: 20 cm are 35 pixels at 3 m, where half a pixel at an end
  /// turns the line by a degree.
  double min_length = 0.20;
  /// Bounds across: the image measures an edge to a pixel or two, which is 10 mm at 3 m for a focal
  /// length of 525 px and, in opposite directions at both ends of 20 cm, 3 degrees. A line with a
  /// larger offset belongs to another edge.
  double max_across = 0.01;                         ///< metres
  double max_angle_across = DegreesToRadians(3.0);  ///< radians
  /// Bounds along the viewing direction: the depth at one or both ends may be that of the surface
  /// behind the edge. 0.1 m are ten standard deviations of a Kinect at 2.5 m; over 20 cm they are a
  /// slope of 27 degrees.
  double max_along = 0.10;                    ///< metres
  double max_angle = DegreesToRadians(27.0);  ///< radians, total angle
  /// Distance of the line's midpoint beyond the end of the edge, metres: lines grow while they are
  /// observed.
  double max_beyond = 0.10;

  /// If an option is invalid, `error` names it and its valid range.
  bool IsValid(std::string* error) const;
};

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

/// Compares map lines with the true edges of a scene. Each line is matched with the edge that has
/// the smallest sum of squared offsets, each relative to its bound in the options; edges outside of
/// the bounds are excluded. On ties the first edge is taken. Several lines may be matched with one
/// edge, because a map may hold an edge in parts. The bounds are tighter across the viewing
/// direction, so neighbouring edges are distinguished by the image, which is accurate, and not by
/// depth, whose error is to be measured.
/// Throws std::invalid_argument on invalid options and on edges without length.
LineError EvaluateLines(const std::vector<LineSegment3>& edges,
                        const std::vector<EstimatedLine>& lines,
                        const Rigid3& reference_from_estimate,
                        const LineEvaluationOptions& options = {});

}  // namespace msc_vo
