// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

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

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, segment, sigma, dynamic, depth, descriptor);
  }
};

}  // namespace msc_vo
