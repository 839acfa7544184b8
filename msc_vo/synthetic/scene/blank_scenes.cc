// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <array>
#include <cmath>

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

const Eigen::Vector3f kPlainWhite(0.86f, 0.86f, 0.86f);

// Adds a hall without furniture, lit from one side so that its walls differ in brightness. Returns
// the texture of its walls.
Texture AddBlankHall(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                     SceneBuilder* builder) {
  const Texture white = builder->NewTexture(TextureKind::kPlain, kPlainWhite);
  const Texture floor = builder->NewTexture(TextureKind::kPlain, 0.75f * kPlainWhite);
  builder->AddHall(low, high, floor, white, white);
  builder->scene().ambient = 0.36;
  const double x = high.x() - low.x(), y = high.y() - low.y();
  builder->scene().lights = {{{low.x() + 0.7 * x, low.y() + 0.4 * y, high.z() - 0.3}, 0.85, 2.4},
                             {{low.x() + 0.2 * x, low.y() + 0.6 * y, high.z() - 0.3}, 0.30, 2.4}};
  return white;
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

// Adds `count` upright panels that zigzag at +-45 degrees from `from` in direction `along`. Their
// visible sides face to the left of `along`.
void AddZigZag(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double panel,
               double height, int count, const Texture& texture, SceneBuilder* builder) {
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(along);
  Eigen::Vector3d at = from;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d step =
        panel * std::sqrt(0.5) * (along + (i % 2 == 0 ? 1.0 : -1.0) * left);
    // step x up points to the right of the step: start at the far end to face left.
    builder->AddQuad({at + step, -step, height * Eigen::Vector3d::UnitZ(), texture});
    at += step;
  }
}

}  // namespace

Scene MakeBare(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 2.6 + random.Uniform(-0.1, 0.2), y = 2.3 + random.Uniform(-0.1, 0.2);
  const Texture white = AddBlankHall({-x, -y, 0}, {x, y, 2.5}, &builder);
  // Instead of those of the hall.
  builder.scene().lights = {{{0.9, -0.5, 2.2}, 0.85, 2.4}, {{-1.4, 0.3, 2.2}, 0.30, 2.4}};

  // Folds along the two long walls, facing the middle.
  const double panel = 0.62, fold = panel * std::sqrt(0.5);
  const int folds = 2 * static_cast<int>((2.0 * x - 0.4) / (2.0 * fold));
  const double start = 0.5 * folds * fold;
  AddZigZag({-start, -y + 0.05, 0}, Eigen::Vector3d::UnitX(), panel, 1.8, folds, white, &builder);
  AddZigZag({start, y - 0.05, 0}, -Eigen::Vector3d::UnitX(), panel, 1.8, folds, white, &builder);
  // Boxes along the two other walls, parallel to them.
  for (const double sign : {-1.0, 1.0}) {
    double at = -y + 0.65;
    while (at < y - 1.0) {
      const double width = random.Uniform(0.35, 0.6), depth = random.Uniform(0.3, 0.7);
      const double tall = random.Uniform(0.4, 1.5);
      builder.AddBox(UprightFrame({sign * x, 0, 0}, sign * 0.5 * kPi), {sign * at, 0, 0},
                     {sign * at + width, depth, tall}, white);
      at += width + random.Uniform(0.1, 0.3);
    }
  }
  // Low boxes in the middle, below the trajectory.
  builder.AddBox(UprightFrame({0, 0, 0}, 0.0), {-0.55, -0.3, 0}, {0.05, 0.3, 0.55}, white);
  builder.AddBox(UprightFrame({0, 0, 0}, 0.0), {0.05, -0.3, 0}, {0.5, 0.15, 0.3}, white);

  const int count = 8;
  for (int i = 0; i < count; ++i) {
    const double around = 2.0 * kPi * i / count, ahead = around + DegreesToRadians(100.0);
    builder.AddWaypoint(
        {0.9 * std::cos(around), 0.75 * std::sin(around), 1.35 + random.Uniform(-0.12, 0.12)},
        {x * std::cos(ahead), y * std::sin(ahead), random.Uniform(0.5, 0.8)});
  }
  return builder.scene();
}

Scene MakeBlank(uint64_t seed, const WalkOptions& /*walk*/) {
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

Scene MakeZigZag(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const Texture white = builder.NewTexture(TextureKind::kPlain, kPlainWhite);
  AddBlankHall({-4.0, -3.0, 0}, {4.0, 3.0, 2.5}, &builder);
  // Upright panels at +-45 degrees, as high as the hall, that face the middle of it.
  const double panel = 0.55 + random.Uniform(-0.05, 0.05), fold = panel * std::sqrt(0.5);
  const int count = 2 * static_cast<int>(3.0 / fold);
  AddZigZag({-0.5 * count * fold, -1.0, 0.0}, Eigen::Vector3d::UnitX(), panel, 2.5, count, white,
            &builder);
  // So close that the image shows little else.
  AddWalkPastAWall(0.9, 0.35, {0.8, 0.3}, -0.8, &builder);
  return builder.scene();
}

Scene MakeDeadEnd(uint64_t seed, const WalkOptions& /*walk*/) {
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

Scene MakePoster(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 3.0, y = 2.0;
  AddBlankHall({-x, -y, 0}, {x, y, 2.5}, &builder);
  AddPicture(UprightFrame({random.Uniform(-0.2, 0.2), -y, 0}, 0.0), {0.6, 0.8}, 1.4, &builder);
  AddWalkPastAWall(1.75, -0.6, {1.35, 1.3}, -y, &builder);
  return builder.scene();
}

}  // namespace msc_vo
