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

struct LineEvaluationOptions {
  // Lines that say little of the method are left out: of fewer views no third one has confirmed the
  // match of the first two; shorter ones are 35 pixels at 3 m, a degree of direction per half pixel
  // at an end.
  int min_observations = 3;
  double min_length = 0.20;  // metres
  // How far a line may be from the edge that it shows. In the image an edge is known to a pixel or
  // two, which are 10 mm at 3 m with a focal length of 525 px and, at both ends of 20 cm in
  // opposite directions, 3 degrees. What is farther beside is another edge.
  double max_across = 0.01;                         // metres
  double max_angle_across = DegreesToRadians(3.0);  // radians
  // Depth is another matter: it may be that of the surface behind, at one end or at both. A
  // decimetre is ten standard deviations of a Kinect at 2.5 m, and from one end of 20 cm to the
  // other a slope of 27 degrees: of such a line nothing but its image is known.
  double max_along = 0.10;                    // metres
  double max_angle = DegreesToRadians(27.0);  // radians, in all directions together
  // Metres, of the line's middle beyond the edge's end: lines grow while they are observed.
  double max_beyond = 0.10;

  bool IsValid(std::string* error) const;
};

// A line of a map.
struct EstimatedLine {
  LineSegment3 segment;  // metres
  int num_observations = 0;
  // Unit vector, mean of the directions from the cameras that saw it to the line.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
};

// How well the lines of a map agree with the edges of the scene. Never read the errors without the
// counts: a map that lost its bad lines has an easy life.
struct LineError {
  int num_lines = 0;        // of the map
  int num_counted = 0;      // seen often enough and long enough
  int num_matched = 0;      // of these, with an edge
  int num_edges = 0;        // of the scene, seen or not
  int num_edges_found = 0;  // edges that are matched with at least one line

  ErrorStatistics direction;  // radians, between a line and its edge
  ErrorStatistics distance;   // metres, of the line's middle from the edge's infinite line
  ErrorStatistics across;     // metres, the part of the distance that the cameras see
};

// Compares map lines with the true edges of a scene. A line's partner is the edge within the bounds
// of the options that has the least sum of squared offsets, each in units of its bound; the first
// of equals, whatever other lines have it too (a map may hold an edge in parts). Distance and angle
// are bounded more tightly across the sight, perpendicular to the edge and to the viewing
// direction: neighbouring edges are told apart by what the image says, which is known well, and not
// by depth, whose error is to be measured. Throws std::invalid_argument on options that are not
// valid and on edges without a length.
LineError EvaluateLines(const std::vector<LineSegment3>& edges,
                        const std::vector<EstimatedLine>& lines,
                        const Rigid3& reference_from_estimate,
                        const LineEvaluationOptions& options = {});

}  // namespace msc_vo
