// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/room_steps.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

const Eigen::Vector3f kEndWallColor(0.80f, 0.82f, 0.80f);

// A room with the half of the corridor in front of it that is nearer to it.
Scene MakeRoomWithCorridor(const RoomPlan& plan, uint64_t seed) {
  Scene part = MakeRoomModule(plan, seed);
  for (Quad& quad : part.quads) quad.zone = quad.zone == 0 ? 0 : 1;
  SceneBuilder builder(seed, 1);
  const double x = 0.5 * plan.pitch, middle = plan.CorridorMiddle();
  const Texture floor = builder.NewTexture(TextureKind::kTiles, {0.46f, 0.48f, 0.50f});
  const Texture ceiling = builder.NewTexture(TextureKind::kPlain, {0.9f, 0.9f, 0.9f});
  builder.AddQuad({{-x, middle, 0}, {2 * x, 0, 0}, {0, -plan.wall - middle, 0}, floor});
  builder.AddQuad({{x, middle, plan.height}, {-2 * x, 0, 0}, {0, -plan.wall - middle, 0}, ceiling});
  AddPicture(UprightFrame({0, -plan.wall, 0}, kPi), {0.8, 0.6}, 1.5, &builder);
  builder.scene().lights = {{{0, middle, plan.height - 0.25}, 0.75, 1.7}};
  AddCopy(builder.scene(), {}, 1, &part);
  return part;
}

// The walls at both ends of the corridor.
Scene MakeEnds(const RoomPlan& plan, uint64_t seed) {
  SceneBuilder builder(seed, 2);
  const Texture paint = builder.NewTexture(TextureKind::kPlaster, kEndWallColor);
  const double low = -plan.wall - plan.corridor, width = plan.corridor;
  builder.AddQuad({{-0.5 * plan.pitch, low, 0}, {0, width, 0}, {0, 0, plan.height}, paint});
  builder.AddQuad({{1.5 * plan.pitch, -plan.wall, 0}, {0, -width, 0}, {0, 0, plan.height}, paint});
  return builder.scene();
}

// The walk from the right door of a room to the right door of the one diagonally opposite.
std::vector<Step> DiagonalSteps(const RoomPlan& plan) {
  const double door = plan.door, pitch = plan.pitch, y = plan.CorridorMiddle();
  return {{door + 0.2, y + 0.05, -55}, {0.5 * pitch, y, 0}, {pitch - door - 0.2, y - 0.05, -55}};
}

}  // namespace

Scene MakeMirrored(uint64_t seed, const WalkOptions& walk) {
  Random random(seed);
  const RoomPlan plan = DrawRoomPlan(&random);
  Scene scene = MakeLookAlikeShell();
  std::vector<Placement> placements;
  for (const double along : {1.0, -1.0}) {
    for (const double across : {1.0, -1.0}) {
      placements.push_back({Eigen::Vector3d(along, across, 1.0).asDiagonal(),
                            {along > 0.0 ? 0.0 : plan.pitch,
                             across > 0.0 ? 0.0 : 2.0 * plan.CorridorMiddle(), 0.0}});
    }
  }
  AddLookAlikes(MakeRoomWithCorridor(plan, seed), placements, 2, seed, MakeRoomMark, &scene);
  AddCopy(MakeEnds(plan, seed), {}, 1, &scene);

  TourWriter writer(seed, walk);
  const RoomSteps steps(plan);
  const Placement &start = placements[0], &opposite = placements[1], &beside = placements[2],
                  &diagonal = placements[3];
  writer.Add(start, steps.PassToRight());
  if (!walk.returns) writer.Add(start, DiagonalSteps(plan));
  const Placement& second = walk.returns ? opposite : diagonal;
  writer.Add(second, {{plan.door, -0.5, 90}});
  writer.Add(second, MirrorSteps(steps.EnterByLeft()));
  writer.Add(second, MirrorSteps(steps.PassToRight()));
  const Placement& third = walk.returns ? start : beside;
  writer.Add(third, {{-plan.door, -0.5, 90}});
  writer.Add(third, steps.EnterByLeft());
  writer.Add(third, walk.returns ? MirrorSteps(steps.LookAtBack()) : steps.StayAtLeft());
  scene.tour = writer.tour();
  return scene;
}

}  // namespace msc_vo
