// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

std::shared_ptr<const Frame> MarkMovingFeatures(const ConsensusOptions& options,
                                                const TrackedFrame& tracked) {
  if (tracked.moving_parts.empty()) return tracked.frame;
  auto marked = std::make_shared<Frame>(*tracked.frame);
  const ImageParts parts(options.columns, options.rows, marked->camera);
  for (PointFeature& point : marked->points) {
    point.moves = tracked.moving_parts[parts.PartOf(point.pixel)];
  }
  for (LineFeature& line : marked->lines) {
    line.moves = tracked.moving_parts[parts.PartOf(line.segment)];
  }
  for (const PointMatch& match : tracked.matches.points) {
    marked->points[match.feature].moves = false;
  }
  for (const LineMatch& match : tracked.matches.lines) marked->lines[match.feature].moves = false;
  return marked;
}

}  // namespace msc_vo
