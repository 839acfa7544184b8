// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

const Eigen::Vector3f kPlainWhite(0.86f, 0.86f, 0.86f);

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

Scene MakeBare(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 2.6 + random.Uniform(-0.1, 0.2), y = 2.3 + random.Uniform(-0.1, 0.2);
  const double height = 2.5;
  const Texture white = builder.NewTexture(TextureKind::kPlain, kPlainWhite);
  const Texture floor = builder.NewTexture(TextureKind::kPlain, 0.75f * kPlainWhite);
  builder.AddHall({-x, -y, 0}, {x, y, height}, floor, white, white);
  builder.scene().ambient = 0.36;
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

}  // namespace msc_vo
