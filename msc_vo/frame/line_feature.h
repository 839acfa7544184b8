// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include <Eigen/Core>

#include "msc_vo/frame/descriptor.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// A line feature l_j of the paper. Pixels are undistorted.
struct LineFeature {
  LineSegment2 segment;
  double sigma = 1.0;              ///< pixels, of an end point's distance to the true line
  bool dynamic = false;            ///< as for points
  std::optional<LineDepth> depth;  ///< none: the line stays 2-D
  Descriptor descriptor{};

  bool HasDepth() const { return depth.has_value(); }
  void RemoveDepth() { depth.reset(); }
  /// As for points; the inverse depth exists if HasDepth().
  Eigen::Vector2d Center() const { return segment.Midpoint(); }
  double CenterInverseDepth() const { return depth->At(0.5); }
  double CenterInverseDepthSigma() const { return depth->SigmaAt(0.5); }
  /// As for points; without a depth, `inverse_depth` is zero.
  template <typename Move>
  void MovePixels(const Move& move) {
    LineDepth at_infinity;
    LineDepth& moved = depth ? *depth : at_infinity;
    segment.start = move(segment.start, &moved.start);
    segment.end = move(segment.end, &moved.end);
  }
};

}  // namespace msc_vo
