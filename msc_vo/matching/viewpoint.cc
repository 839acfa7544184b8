// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/viewpoint.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Highest pyramid level of the extractor's default.
constexpr int kExtractedLevel = 7;

}  // namespace

Viewpoint::Viewpoint(const Frame& frame_in, const Rigid3& cam_from_world_in)
    : frame(frame_in),
      cam_from_world(cam_from_world_in),
      center(cam_from_world.OriginInSource()),
      lowest_level(0),
      highest_level(kExtractedLevel) {
  for (const PointFeature& point : frame.points) {
    lowest_level = std::min(lowest_level, point.level);
    highest_level = std::max(highest_level, point.level);
  }
}

}  // namespace msc_vo
