// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

const Eigen::Vector3f kCardboard(0.62f, 0.50f, 0.36f);
const Eigen::Vector3f kGrey(0.70f, 0.70f, 0.68f);

constexpr double kHalfHall = 4.5, kHallHeight = 3.0;  // metres

// Adds crates along a circle in front of the walls, each turned as it happens to stand.
void AddCrates(SceneBuilder* builder) {
  Random& random = builder->random();
  const int count = 9;
  for (int i = 0; i < count; ++i) {
    const double around = 2.0 * kPi * (i + random.Uniform(-0.25, 0.25)) / count;
    const double away = random.Uniform(2.9, 3.6);
    const Eigen::Vector3f color = static_cast<float>(random.Uniform(0.6, 1.1)) * kCardboard;
    const Texture texture = builder->NewTexture(TextureKind::kPlain, color);
    const Rigid3 frame = UprightFrame({away * std::cos(around), away * std::sin(around), 0},
                                      random.Uniform(0.0, 2.0 * kPi));
    const double x = random.Uniform(0.15, 0.35), y = random.Uniform(0.15, 0.3);
    builder->AddBox(frame, {-x, -y, 0}, {x, y, random.Uniform(0.3, 0.9)}, texture);
  }
}

// Adds an orbit around the box, from slightly above.
void AddOrbit(SceneBuilder* builder) {
  Random& random = builder->random();
  const int count = 12;
  for (int i = 0; i < count; ++i) {
    const double around = 2.0 * kPi * i / count, radius = random.Uniform(1.05, 1.15);
    builder->AddWaypoint(
        {radius * std::cos(around), radius * std::sin(around), random.Uniform(0.75, 0.85)},
        {0, 0, 0.2});
  }
}

}  // namespace

Scene MakeBox(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const Texture floor = builder.NewTexture(TextureKind::kPlaster, 0.75f * kGrey);
  const Texture walls = builder.NewTexture(TextureKind::kPlain, kGrey);
  builder.AddHall({-kHalfHall, -kHalfHall, 0}, {kHalfHall, kHalfHall, kHallHeight}, floor, walls,
                  walls);
  builder.scene().ambient = 0.36;
  builder.scene().lights = {{{1.2, -0.8, 2.6}, 0.8, 2.4}, {{-1.6, 0.9, 2.6}, 0.35, 2.4}};
  const Texture cardboard = builder.NewTexture(TextureKind::kPlain, kCardboard);
  const double x = random.Uniform(0.25, 0.35), y = random.Uniform(0.18, 0.26);
  builder.AddBox(UprightFrame({0, 0, 0}, random.Uniform(0.0, 0.5 * kPi)), {-x, -y, 0},
                 {x, y, random.Uniform(0.3, 0.45)}, cardboard);
  AddCrates(&builder);
  AddOrbit(&builder);
  return builder.scene();
}

}  // namespace msc_vo
