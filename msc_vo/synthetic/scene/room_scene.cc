// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

constexpr double kQuarter = 0.5 * kPi;
const Eigen::Vector3f kPaint(0.86f, 0.84f, 0.78f);

struct RoomSize {
  double x = 6.0, y = 5.0, z = 2.6;  // metres
};

// Adds the walls, floor and ceiling of a room; the origin is the centre of the floor.
void AddShell(const RoomSize& size, SceneBuilder* builder) {
  const Texture floor =
      builder->NewTexture(TextureKind::kPlanks, {0.62f, 0.45f, 0.28f}, {0.22f, 0.15f, 0.10f});
  const Texture ceiling = builder->NewTexture(TextureKind::kPlaster, {0.9f, 0.9f, 0.88f});
  const Texture walls = builder->NewTexture(TextureKind::kPlaster, kPaint);
  builder->AddHall({-0.5 * size.x, -0.5 * size.y, 0}, {0.5 * size.x, 0.5 * size.y, size.z}, floor,
                   ceiling, walls);
  builder->scene().lights = {{{0.6, 0.4, size.z - 0.3}, 0.95, 2.8},
                             {{-0.45 * size.x, 0.0, 1.7}, 0.35, 3.0}};  // lamp and window
  builder->scene().ambient = 0.36;
}

// Adds furniture along the four walls; the frame of each side faces into the room.
void FurnishWalls(const RoomSize& size, SceneBuilder* builder) {
  const double x = 0.5 * size.x, y = 0.5 * size.y;
  const Texture skirting = builder->NewTexture(TextureKind::kPlain, {0.92f, 0.92f, 0.9f});
  const auto south = [&](double at) { return UprightFrame({at, -y, 0}, 0.0); };
  const auto north = [&](double at) { return UprightFrame({at, y, 0}, 2.0 * kQuarter); };
  const auto west = [&](double at) { return UprightFrame({-x, at, 0}, -kQuarter); };
  const auto east = [&](double at) { return UprightFrame({x, at, 0}, kQuarter); };

  AddCounter(south(-0.9), 2.8, builder);
  AddDoor(south(1.75), {0.9, 2.05}, {0.80f, 0.76f, 0.68f}, builder);
  AddSkirting(south(0.0), {{0.55, 1.2}, {2.3, x}}, skirting, builder);

  AddBookcase(north(-1.6), {1.6, 2.0}, builder);
  AddPicture(north(0.3), {0.9, 0.65}, 1.55, builder);
  const Texture oak = builder->NewTexture(TextureKind::kWood, {0.62f, 0.44f, 0.27f});
  AddCupboard(north(0.4), {1.5, 0.9}, 0.4, 3, oak, builder);
  AddClutter(north(0.4) * Rigid3({1, 0, 0, 0}, {0, 0.2, 0}), {1.3, 0.3}, 0.9, 4, builder);
  AddPicture(north(1.9), {0.6, 0.8}, 1.6, builder);
  AddSkirting(north(0.0), {{-x, -0.36}, {1.15, 0.8}, {2.4, x}}, skirting, builder);

  AddWindow(west(0.0), {1.9, 1.3}, 0.95, builder);
  AddTable(west(0.0) * Rigid3({1, 0, 0, 0}, {0, 0.4, 0}), {1.5, 0.65}, 0.74, builder);
  AddPicture(west(-1.6), {0.5, 0.7}, 1.5, builder);
  AddPicture(west(1.6), {0.5, 0.4}, 1.4, builder);
  AddSkirting(west(0.0), {{-y, y}}, skirting, builder);

  AddSofa(east(0.2), 2.2, builder);
  AddPicture(east(-0.4), {0.8, 0.6}, 1.55, builder);
  AddPicture(east(0.7), {0.7, 0.9}, 1.6, builder);
  AddBookcase(east(-1.75), {0.9, 1.8}, builder);
  AddPicture(east(1.75), {0.45, 0.6}, 1.5, builder);
  AddSkirting(east(0.0), {{-y, y}}, skirting, builder);
}

void FurnishMiddle(const RoomSize& size, SceneBuilder* builder) {
  Random& random = builder->random();
  AddRug(UprightFrame({0.1, 0.0, 0}, 0.0), {2.6, 1.9}, builder);
  const double shift = random.Uniform(-0.15, 0.15);
  AddTable(UprightFrame({shift, 0, 0.008}, 0.0), {1.4, 0.85}, 0.75, builder);
  AddChair(UprightFrame({shift - 0.35, -0.62, 0}, 0.0), builder);
  AddChair(UprightFrame({shift + 0.4, -0.66, 0}, 0.0), builder);
  AddChair(UprightFrame({shift + 0.3, 0.64, 0}, 2.0 * kQuarter), builder);
  AddCeilingLamp(UprightFrame({0.6, 0.4, size.z}, 0.0), {0.8, 0.3}, builder);
}

}  // namespace

Scene MakeRoom(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  RoomSize size;
  size.x += random.Uniform(-0.2, 0.4);
  size.y += random.Uniform(-0.1, 0.4);
  AddShell(size, &builder);
  FurnishWalls(size, &builder);
  FurnishMiddle(size, &builder);
  // Around the table, above the chairs, with the camera pointing ahead and at the walls.
  const int count = 10;
  for (int i = 0; i < count; ++i) {
    const double at = 2.0 * kPi * i / count, ahead = at + DegreesToRadians(70.0);
    const Eigen::Vector3d position((0.5 * size.x - 1.75) * std::cos(at),
                                   (0.5 * size.y - 1.45) * std::sin(at),
                                   1.45 + random.Uniform(-0.15, 0.15));
    builder.AddWaypoint(position, {0.5 * size.x * std::cos(ahead), 0.5 * size.y * std::sin(ahead),
                                   random.Uniform(0.85, 1.25)});
  }
  return builder.scene();
}

}  // namespace msc_vo
