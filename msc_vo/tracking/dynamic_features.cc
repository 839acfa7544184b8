// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const TrackedFrame& tracked) {
  if (tracked.dynamic_cells.empty()) return tracked.frame;
  auto marked = std::make_shared<Frame>(*tracked.frame);
  const ImageGrid grid(options.columns, options.rows, marked->camera);
  for (PointFeature& point : marked->points) {
    point.dynamic = tracked.dynamic_cells[grid.CellOf(point.pixel)];
  }
  for (LineFeature& line : marked->lines) {
    line.dynamic = tracked.dynamic_cells[grid.CellOf(line.segment)];
  }
  for (const PointMatch& match : tracked.matches.points) {
    marked->points[match.feature].dynamic = false;
  }
  for (const LineMatch& match : tracked.matches.lines) marked->lines[match.feature].dynamic = false;
  return marked;
}

}  // namespace msc_vo
