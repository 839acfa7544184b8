// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include "msc_vo/synthetic/scene/scene_builder.h"

namespace msc_vo {

// Parts of which scenes with places that look alike consist: copies have the same shape, texture
// and light.

/// Dimensions of a room with two doors in its front wall, metres. In the frame of a room, x runs
/// along the front wall from its middle, y into the room from the inner side of the front wall, z
/// up from the floor.
struct RoomPlan {
  double width = 3.8, depth = 3.5, height = 2.6;
  double door = 1.1;       ///< distance of the doors from the middle
  double half_door = 0.5;  ///< half width of a doorway
  double lintel = 2.1;     ///< height of a doorway
  double wall = 0.12;      ///< thickness of the front wall
  double pitch = 3.9;      ///< distance of two rooms side by side
  double corridor = 1.9;   ///< width of the corridor in front
  Eigen::Vector3f door_color{0.66f, 0.55f, 0.42f};
  double CorridorMiddle() const { return -wall - 0.5 * corridor; }
};

/// Draws the dimensions.
RoomPlan DrawRoomPlan(Random* random);

/// A furnished room with its front wall. The lights of zone 0 are those of the room; the outer side
/// of the front wall is in zone -2 beside the left door, and in zone 1 beside the right one.
Scene MakeRoomModule(const RoomPlan& plan, uint64_t seed);

/// A small picture beside the doors, with which a room differs from others.
Scene MakeRoomMark(uint64_t seed);

/// Adds a copy of a part; `zone` is added to its zones.
void AddCopy(const Scene& part, const Placement& placement, int zone, Scene* scene);

/// An empty scene with the light of scenes of look-alikes, which prefers no horizontal direction,
/// and a tour that is no loop.
Scene MakeLookAlikeShell();

/// Adds copies of a part to a scene as its look-alikes, each with the given increment of zones; in
/// odd seeds, each with a mark of its own.
template <typename MakeMark>
void AddLookAlikes(const Scene& part, const std::vector<Placement>& placements, int zones,
                   uint64_t seed, const MakeMark& make_mark, Scene* scene) {
  for (size_t i = 0; i < placements.size(); ++i) {
    const int zone = zones * static_cast<int>(i);
    AddCopy(part, placements[i], zone, scene);
    if (seed % 2 == 1) AddCopy(make_mark(seed + 1000 * (i + 1)), placements[i], zone, scene);
  }
  scene->look_alikes = placements;
}

}  // namespace msc_vo
