// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/room_steps.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

constexpr double kStorey = 2.8;                   // height from floor to floor, metres
constexpr double kShaft = 1.8, kHalfShaft = 0.9;  // side of the lift shaft, metres

// One storey: a room whose right door opens into the shaft, and whose left door is closed.
Scene MakeStorey(const RoomPlan& plan, uint64_t seed) {
  Scene part = MakeRoomModule(plan, seed);
  for (Quad& quad : part.quads) quad.zone = quad.zone == 0 ? 0 : 1;
  SceneBuilder closed(seed, 2);
  AddDoor(UprightFrame({-plan.door, -0.5 * plan.wall, 0}, 0.0), {2.0 * plan.half_door, plan.lintel},
          plan.door_color, &closed);
  AddCopy(closed.scene(), {}, 0, &part);

  SceneBuilder builder(seed, 1);
  const double back = -plan.wall - kShaft, left = plan.door - kHalfShaft;
  const Texture tiles =
      builder.NewTexture(TextureKind::kTiles, {0.66f, 0.66f, 0.62f}, {0.35f, 0.35f, 0.36f}, 1.4f);
  const Texture slab = builder.NewTexture(TextureKind::kPlaster, {0.55f, 0.54f, 0.52f});
  builder.AddHall({left, back, 0}, {left + kShaft, -plan.wall, kStorey}, tiles, tiles, tiles);
  std::vector<Quad>& quads = builder.scene().quads;
  quads = {quads[0], quads[1], quads[3]};  // without floor, ceiling and front
  builder.AddBox(Rigid3(), {left, -plan.wall, plan.height}, {left + kShaft, 0, kStorey}, slab);
  for (const double height : {0.7, 1.6, 2.5}) {
    for (const double x : {-0.4, 0.4}) {
      AddPicture(UprightFrame({plan.door + x, back, 0}, 0.0), {0.5, 0.4},
                 height + builder.random().Uniform(-0.12, 0.12), &builder);
    }
  }
  const double middle = 0.5 * (back - plan.wall);
  AddPicture(UprightFrame({left, middle, 0}, -0.5 * kPi), {0.7, 0.9}, 1.4, &builder);
  AddPicture(UprightFrame({left + kShaft, middle, 0}, 0.5 * kPi), {0.9, 0.7}, 1.4, &builder);
  builder.scene().lights = {{{plan.door, middle, plan.height - 0.3}, 0.7, 1.7}};
  AddCopy(builder.scene(), {}, 1, &part);
  return part;
}

// Floor and ceiling of the shaft.
Scene MakeShaftEnds(const RoomPlan& plan, uint64_t seed, double top) {
  SceneBuilder builder(seed, 3);
  const Texture texture = builder.NewTexture(TextureKind::kPlaster, {0.5f, 0.5f, 0.5f});
  const double back = -plan.wall - kShaft, left = plan.door - kHalfShaft;
  builder.AddQuad({{left, back, 0}, {kShaft, 0, 0}, {0, kShaft + plan.wall, 0}, texture});
  builder.AddQuad(
      {{left + kShaft, back, top}, {-kShaft, 0, 0}, {0, kShaft + plan.wall, 0}, texture});
  return builder.scene();
}

// The ride between the storeys, with a view of the back of the shaft, and the turn to its door.
std::vector<Step> RideSteps(const RoomPlan& plan, bool up) {
  const double x = plan.door, y = -plan.wall - 0.48 * kShaft;
  const double start = up ? 0.0 : kStorey, end = kStorey - start;
  std::vector<Step> steps;
  // The turn begins before the end of the ride.
  const double headings[] = {-90, -90, -90, -90, -75, -45, -10, 25, 60, 90};
  for (int i = 0; i < 10; ++i) {
    steps.push_back({x, y, headings[i], start + (end - start) * std::min(1.0, i / 7.0)});
  }
  steps.push_back({x, -0.4, 90, end});
  return steps;
}

}  // namespace

Scene MakeFloors(uint64_t seed, const WalkOptions& walk) {
  Random random(seed);
  const RoomPlan plan = DrawRoomPlan(&random);
  Scene scene = MakeLookAlikeShell();
  const Placement lower, upper{Eigen::Matrix3d::Identity(), {0, 0, kStorey}};
  AddLookAlikes(MakeStorey(plan, seed), {lower, upper}, 2, seed, MakeRoomMark, &scene);
  AddCopy(MakeShaftEnds(plan, seed, 2.0 * kStorey), lower, 1, &scene);

  TourWriter writer(seed, walk);
  const RoomSteps steps(plan);
  writer.Add(lower, steps.PassToRight());
  writer.Add(lower, RideSteps(plan, true));
  writer.Add(upper, MirrorSteps(steps.EnterByLeft()));
  if (walk.returns) {
    writer.Add(upper, MirrorSteps(steps.TurnBackToLeft()));
    writer.Add(lower, RideSteps(plan, false));
    writer.Add(lower, MirrorSteps(steps.EnterByLeft()));
    const std::vector<Step> back = steps.LookAtBack();
    writer.Add(lower, {back.begin(), back.begin() + 3});
  } else {
    writer.Add(upper, MirrorSteps(steps.StayAtLeft()));
  }
  scene.tour = writer.tour();
  return scene;
}

}  // namespace msc_vo
