// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/viewpoint.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Highest pyramid level of the extractor's default.
constexpr int kMaxLevel = 7;

int HighestLevel(const Frame& frame) {
  int level = kMaxLevel;
  for (const PointFeature& point : frame.points) level = std::max(level, point.level);
  return level;
}

}  // namespace

Viewpoint::Viewpoint(const Frame& frame_in, const Rigid3& cam_from_world_in)
    : frame(frame_in),
      cam_from_world(cam_from_world_in),
      center(cam_from_world.OriginInSource()),
      highest_level(HighestLevel(frame)) {}

}  // namespace msc_vo
