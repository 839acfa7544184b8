// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

constexpr double kLength = 16.0, kWidth = 1.9, kCorridorHeight = 2.5;  // metres
const Eigen::Vector3f kDoorColor(0.66f, 0.55f, 0.42f);

// Adds doors along a wall and the skirting boards between them. The origin of `side_frame` is the
// middle of the wall, its x axis is along the corridor.
void AddSide(const Rigid3& side_frame, const Texture& skirting, SceneBuilder* builder) {
  Random& random = builder->random();
  const int count = 5;
  const double pitch = kLength / count, half_door = 0.53;
  std::vector<Span> spans;
  double low = -0.5 * kLength;
  for (int i = 0; i < count; ++i) {
    const double at = -0.5 * kLength + (i + 0.5) * pitch + random.Uniform(-0.6, 0.6);
    AddDoor(side_frame * Rigid3({1, 0, 0, 0}, {at, 0, 0}), {0.9, 2.02}, kDoorColor, builder);
    spans.push_back({low, at - half_door});
    low = at + half_door;
  }
  spans.push_back({low, 0.5 * kLength});
  AddSkirting(side_frame, spans, skirting, builder);
}

}  // namespace

Scene MakeCorridor(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 0.5 * kLength, y = 0.5 * kWidth;
  const Texture floor = builder.NewTexture(TextureKind::kPlaster, {0.42f, 0.44f, 0.46f});
  const Texture ceiling = builder.NewTexture(TextureKind::kPlain, {0.9f, 0.9f, 0.9f});
  const Texture walls = builder.NewTexture(TextureKind::kPlaster, {0.80f, 0.82f, 0.80f});
  builder.AddHall({-x, -y, 0}, {x, y, kCorridorHeight}, floor, ceiling, walls);
  builder.scene().ambient = 0.42;

  const Texture skirting = builder.NewTexture(TextureKind::kPlain, {0.30f, 0.31f, 0.33f});
  AddSide(UprightFrame({0, -y, 0}, 0.0), skirting, &builder);
  AddSide(UprightFrame({0, y, 0}, kPi), skirting, &builder);
  for (const double sign : {-1.0, 1.0}) {
    const Rigid3 end = UprightFrame({sign * x, 0, 0}, sign * 0.5 * kPi);
    AddDoor(end, {0.95, 2.05}, kDoorColor, &builder);
    AddSkirting(end, {{-y, -0.56}, {0.56, y}}, skirting, &builder);
  }
  const Texture handrail = builder.NewTexture(TextureKind::kPlain, {0.5f, 0.4f, 0.3f});
  for (int i = 0; i < 4; ++i) {
    const double at = -x + (i + 0.5) * kLength / 4.0;
    AddCeilingLamp(UprightFrame({at, 0, kCorridorHeight}, 0.0), {1.2, 0.25}, &builder);
    builder.scene().lights.push_back({{at, 0, kCorridorHeight - 0.25}, 0.75, 1.7});
    // A switch box on one side and a notice on the other, for a few points.
    const double beside = at + random.Uniform(-0.3, 0.3);
    builder.AddBox(UprightFrame({beside, -y, 1.1}, 0.0), {-0.04, 0, 0}, {0.04, 0.012, 0.12},
                   handrail);
    AddPicture(UprightFrame({beside, y, 0}, kPi), {0.21, 0.3}, 1.5, &builder);
  }
  // Along the corridor and back, with a narrow turn at each end.
  const double turn = x - 1.6;
  for (int leg = 0; leg < 2; ++leg) {
    const double way = leg == 0 ? 1.0 : -1.0;
    for (int i = 0; i < 7; ++i) {
      const double at = way * turn * (i / 3.0 - 1.0);
      const double side = way * (i % 2 == 0 ? -0.30 : -0.15);
      builder.AddWaypoint({at, side, 1.45 + random.Uniform(-0.08, 0.08)},
                          {at + 2.6 * way, way * random.Uniform(-0.2, 0.9), 1.2});
    }
    // During the turn, the camera faces the side wall.
    builder.AddWaypoint({way * (turn + 0.35), 0.0, 1.45}, {way * turn, 2.5 * way, 1.2});
  }
  return builder.scene();
}

}  // namespace msc_vo
