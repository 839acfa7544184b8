// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

// When two segments are pieces of one line.
struct LineMergingOptions {
  // Radians between their directions: beyond it even pieces of 20 px, whose direction is known to
  // 4 degrees (1 px at each end), are hardly the same line.
  double max_angle = 0.0873;  // 5 degrees
  // Pixels of any of the four end points from the common line: two sigmas of an end point.
  double max_distance = 2.0;
  // Pixels between them along the line: what crosses a line and hides it, such as a thin bar or
  // another edge with the detector's blur. Pieces that overlap have no gap.
  double max_gap = 15.0;

  bool IsValid(std::string* error) const;
};

// Joins pieces of the same line, longest first, until nothing more joins. Directions count: an edge
// from dark to bright and one from bright to dark are not the same line. The result is ordered by
// length, longest first, and does not depend on the order of `segments`.
std::vector<LineSegment2> MergeCollinear(const LineMergingOptions& options,
                                         std::vector<LineSegment2> segments);

}  // namespace msc_vo
