// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <array>
#include <cmath>

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

const Eigen::Vector3f kWhite(0.86f, 0.86f, 0.86f);

// A hall without furniture, lit from one side so that its walls differ in brightness.
void AddBlankHall(const Eigen::Vector3d& low, const Eigen::Vector3d& high, SceneBuilder* builder) {
  const Texture white = builder->NewTexture(TextureKind::kPlain, kWhite);
  const Texture floor = builder->NewTexture(TextureKind::kPlain, 0.75f * kWhite);
  builder->AddHall(low, high, floor, white, white);
  builder->scene().ambient = 0.36;
  const double x = high.x() - low.x(), y = high.y() - low.y();
  builder->scene().lights = {{{low.x() + 0.7 * x, low.y() + 0.4 * y, high.z() - 0.3}, 0.85, 2.4},
                             {{low.x() + 0.2 * x, low.y() + 0.6 * y, high.z() - 0.3}, 0.30, 2.4}};
}

// Waypoints along a wall of constant y and back, from -`reach` to `reach` along x, metres.
// `heights`: of the camera and of what it looks at.
void AddWalkPastAWall(double reach, double y, const Eigen::Vector2d& heights, double wall_y,
                      SceneBuilder* builder) {
  constexpr int kNumSteps = 5;
  Random& random = builder->random();
  for (int leg = 0; leg < 2; ++leg) {
    const double way = leg == 0 ? 1.0 : -1.0;
    for (int i = 0; i <= kNumSteps; ++i) {
      const double along = way * reach * (2.0 * i / kNumSteps - 1.0);
      const double side = y + random.Uniform(-0.1, 0.1);
      const double height = heights[0] + random.Uniform(-0.1, 0.1);
      builder->AddWaypoint({along, side, height},
                           {along + random.Uniform(-0.2, 0.2), wall_y, heights[1]});
    }
  }
}

}  // namespace

Scene MakeBlank(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 2.2 + random.Uniform(-0.2, 0.2), y = 1.9 + random.Uniform(-0.2, 0.2);
  AddBlankHall({-x, -y, 0}, {x, y, 2.5}, &builder);
  // Around the middle, looking outwards: towards corners, along walls and at one wall alone.
  constexpr int kNumWaypoints = 16;
  for (int i = 0; i < kNumWaypoints; ++i) {
    const double angle = 2.0 * kPi * i / kNumWaypoints;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d at = 0.35 * direction;
    const Eigen::Vector2d target = at + 1.5 * direction;
    builder.AddWaypoint({at.x(), at.y(), 1.35 + random.Uniform(-0.1, 0.1)},
                        {target.x(), target.y(), 1.0 + random.Uniform(-0.2, 0.2)});
  }
  return builder.scene();
}

Scene MakeZigZag(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const Texture white = builder.NewTexture(TextureKind::kPlain, kWhite);
  AddBlankHall({-4.0, -3.0, 0}, {4.0, 3.0, 2.5}, &builder);
  // Upright panels at +-45 degrees, as high as the hall, that face the middle of it.
  const double panel = 0.55 + random.Uniform(-0.05, 0.05), fold = panel * std::sqrt(0.5);
  const int count = 2 * static_cast<int>(3.0 / fold);
  Eigen::Vector3d at(-0.5 * count * fold, -1.0, 0.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d step(fold, i % 2 == 0 ? fold : -fold, 0.0);
    builder.AddQuad({at + step, -step, 2.5 * Eigen::Vector3d::UnitZ(), white});
    at += step;
  }
  // So close that the image shows little else.
  AddWalkPastAWall(0.9, 0.35, {0.8, 0.3}, -0.8, &builder);
  return builder.scene();
}

Scene MakeDeadEnd(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 4.5, y = 0.95;
  AddBlankHall({-x, -y, 0}, {x, y, 2.5}, &builder);
  const double left = -2.6 + random.Uniform(-0.2, 0.2), right = -1.2 + random.Uniform(-0.2, 0.2);
  AddDoor(UprightFrame({left, -y, 0}, 0.0), {0.9, 2.02}, {0.66f, 0.55f, 0.42f}, &builder);
  AddDoor(UprightFrame({right, y, 0}, kPi), {0.9, 2.02}, {0.66f, 0.55f, 0.42f}, &builder);
  // Towards the blank end, a halt in front of it, and backwards again.
  for (const double along : {-3.4, -2.4, -1.3, -0.2, 0.9, 1.9, 2.6, 2.7, 2.2, 1.2, 0.2, -1.0}) {
    const double side = random.Uniform(-0.15, 0.15);
    builder.AddWaypoint({along, side, 1.4 + random.Uniform(-0.05, 0.05)},
                        {x, random.Uniform(-0.2, 0.2), 1.2});
  }
  return builder.scene();
}

Scene MakePoster(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 3.0, y = 2.0;
  AddBlankHall({-x, -y, 0}, {x, y, 2.5}, &builder);
  AddPicture(UprightFrame({random.Uniform(-0.2, 0.2), -y, 0}, 0.0), {0.6, 0.8}, 1.4, &builder);
  AddWalkPastAWall(1.75, -0.6, {1.35, 1.3}, -y, &builder);
  return builder.scene();
}

}  // namespace msc_vo
