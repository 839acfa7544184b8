// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/feature_counts.h"

#include <algorithm>

namespace msc_vo {

int NumWithDepth(const Frame& frame) {
  const auto points = std::count_if(frame.points.begin(), frame.points.end(),
                                    [](const PointFeature& point) { return point.HasDepth(); });
  const auto lines = std::count_if(frame.lines.begin(), frame.lines.end(),
                                   [](const LineFeature& line) { return line.depth.has_value(); });
  return static_cast<int>(points + lines);
}

}  // namespace msc_vo
