// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// A line of one frame with a depth.
struct StructureLine {
  LineSegment2 segment;  ///< pixels, undistorted
  LineDepth depth;       ///< in: the fit; out: inverse depths and their covariance
  double sigma = 1.0;    ///< pixels, of an end point's distance to the true line
};

struct FrameStructureOptions {
  /// Largest deviation of a pair's angle from 0 or 90 degrees: 2.5 pair_sigma, the 99 % quantile of
  /// pairs that were built parallel or perpendicular. The paper's "close to" is 5 degrees in
  /// related systems, but structures that lean by 3 to 5 degrees exist. Chosen by measurement, see
  /// docs/lab/structure.md.
  double max_angle = 1.75;  ///< degrees
  /// Standard deviation, degrees, of the true angle of lines that were built parallel or
  /// perpendicular: floors and door frames are within 2 mm per metre (0.1 degrees), furniture and
  /// pictures within about one degree.
  double pair_sigma = 0.7;

  bool IsValid(std::string* error) const;
};

struct FrameStructureSummary {
  bool usable = false;  ///< false: no pairs, or the solver failed; the lines are then unchanged
  int num_parallel = 0;
  int num_perpendicular = 0;
};

/// Refines the depths of a frame's lines by their parallel and perpendicular relations (paper: 3D
/// Feature Position Estimation, second step). A line stays on its image segment: only the inverse
/// depths of its two end points change, weighted by the covariance of their fit. Lines without a
/// partner are unchanged.
///
/// A pair is rejected if its angle is less certain than the gate is wide, or if either line has no
/// more such partners than expected by chance, so that scenes without structure are hardly
/// affected. The resulting covariance counts a line's own fit and those of its partners, but not of
/// partners of partners: an upper bound.
///
/// Throws std::invalid_argument, naming the line by its index, on numbers that are not finite,
/// inverse depths or sigmas <= 0, segments without length, a covariance that is not positive
/// definite, or invalid options.
FrameStructureSummary RefineFrameStructure(const FrameStructureOptions& options,
                                           const PinholeCamera& camera,
                                           std::vector<StructureLine>* lines);

}  // namespace msc_vo
