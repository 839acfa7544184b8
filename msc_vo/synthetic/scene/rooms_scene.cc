// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/room_steps.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

namespace {

constexpr double kBeyondDoor = 0.75;  // length of the corridor beyond the middle of a door, metres
constexpr int kZones = 3;             // of a room and the corridor beside it

// The corridor from the right door of a room to the left door of the next one; x = 0 is the middle.
// Closed doors end it, so that no part of the corridor is seen twice on a walk to other rooms.
Scene MakeCorridorPiece(const RoomPlan& plan, uint64_t seed) {
  SceneBuilder builder(seed, 1);
  const double x = 0.5 * plan.pitch - plan.door + kBeyondDoor;
  const double low = -plan.wall - plan.corridor, middle = plan.CorridorMiddle();
  const Texture floor = builder.NewTexture(TextureKind::kTiles, {0.46f, 0.48f, 0.50f});
  const Texture ceiling = builder.NewTexture(TextureKind::kPlain, {0.9f, 0.9f, 0.9f});
  const Texture walls = builder.NewTexture(TextureKind::kPlaster, {0.80f, 0.82f, 0.80f});
  builder.AddHall({-x, low, 0}, {x, -plan.wall, plan.height}, floor, ceiling, walls);
  std::vector<Quad>& quads = builder.scene().quads;
  quads.erase(quads.begin() + 2);  // faces -y: the front walls of the rooms stand there
  AddPicture(UprightFrame({-0.5 * x, low, 0}, 0.0), {0.9, 0.7}, 1.4, &builder);
  AddPicture(UprightFrame({0.5 * x, low, 0}, 0.0), {0.6, 0.9}, 1.4, &builder);
  AddPicture(UprightFrame({0.0, low, 0}, 0.0), {0.3, 0.4}, 1.4, &builder);
  AddDoor(UprightFrame({-x, middle, 0}, -0.5 * kPi), {0.9, 2.02}, plan.door_color, &builder);
  AddDoor(UprightFrame({x, middle, 0}, 0.5 * kPi), {0.9, 2.02}, plan.door_color, &builder);
  builder.scene().lights = {{{0, middle, plan.height - 0.25}, 0.75, 1.7}};
  AddCeilingLamp(UprightFrame({0, middle, plan.height}, 0.0), {1.2, 0.25}, &builder);
  return builder.scene();
}

// Closes the side of a piece of the corridor that has no room; `side` is -1 at the first room, 1 at
// the last one.
Scene MakeCorridorEnd(const RoomPlan& plan, uint64_t seed, double side) {
  SceneBuilder builder(seed, 2);
  const Texture walls = builder.NewTexture(TextureKind::kPlaster, {0.80f, 0.82f, 0.80f});
  const double door = side * (plan.pitch - plan.door), inner = side * 0.5 * plan.pitch;
  const double outer = door + side * kBeyondDoor;
  builder.AddBox(Rigid3(), {std::min(inner, outer), -plan.wall, 0},
                 {std::max(inner, outer), 0, plan.height}, walls);
  AddDoor(UprightFrame({door, -plan.wall, 0}, kPi), {0.9, 2.02}, plan.door_color, &builder);
  return builder.scene();
}

// The walk from the right door of a room to the left door of the next one.
std::vector<Step> CorridorSteps(const RoomPlan& plan) {
  const double door = plan.door, pitch = plan.pitch, y = plan.CorridorMiddle();
  return {{door + 0.2, y + 0.05, -55},
          {0.5 * pitch, y, 0},
          {pitch - door - 0.2, y + 0.05, 55},
          {pitch - door, -0.5, 90}};
}

}  // namespace

Scene MakeRooms(uint64_t seed, const WalkOptions& walk) {
  Random random(seed);
  const int num_rooms = 3 + random.Index(2);
  const RoomPlan plan = DrawRoomPlan(&random);
  Scene scene = MakeLookAlikeShell();
  std::vector<Placement> placements;
  for (int i = 0; i < num_rooms; ++i) {
    placements.push_back({Eigen::Matrix3d::Identity(), {i * plan.pitch, 0, 0}});
  }
  AddLookAlikes(MakeRoomModule(plan, seed), placements, kZones, seed, MakeRoomMark, &scene);
  const Scene piece = MakeCorridorPiece(plan, seed);
  for (int i = -1; i < num_rooms; ++i) {
    AddCopy(piece, {Eigen::Matrix3d::Identity(), {(i + 0.5) * plan.pitch, 0, 0}}, kZones * i + 1,
            &scene);
  }
  AddCopy(MakeCorridorEnd(plan, seed, -1.0), placements.front(), -2, &scene);
  AddCopy(MakeCorridorEnd(plan, seed, 1.0), placements.back(), kZones * (num_rooms - 1) + 1,
          &scene);

  TourWriter writer(seed, walk);
  const RoomSteps steps(plan);
  const int first = walk.returns ? 0 : writer.random().Index(num_rooms - 2);
  const Placement &a = placements[first], &b = placements[first + 1], &c = placements[first + 2];
  writer.Add(a, steps.PassToRight());
  writer.Add(a, CorridorSteps(plan));
  writer.Add(b, steps.EnterByLeft());
  if (walk.returns) {
    writer.Add(b, steps.TurnBackToLeft());
    writer.Add(b, MirrorSteps(CorridorSteps(plan)));
    writer.Add(a, MirrorSteps(steps.EnterByLeft()));
    writer.Add(a, steps.LookAtBack());
  } else {
    writer.Add(b, steps.PassToRight());
    writer.Add(b, CorridorSteps(plan));
    writer.Add(c, steps.EnterByLeft());
    writer.Add(c, steps.StayAtLeft());
  }
  scene.tour = writer.tour();
  return scene;
}

}  // namespace msc_vo
