// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

namespace {

constexpr int kNumHalls = 2;
constexpr double kHallDistance = 20.0;  // of two halls, metres

// A free-standing board with pictures on its front, which faces +y.
Scene MakeBoard(uint64_t seed) {
  SceneBuilder builder(seed);
  const Texture white = builder.NewTexture(TextureKind::kPlain, {0.86f, 0.86f, 0.86f});
  builder.AddBox(Rigid3(), {-1.0, -0.04, 0.4}, {1.0, 0.0, 2.1}, white);
  for (const double x : {-0.62, 0.0, 0.62}) {
    AddPicture(UprightFrame({x, 0, 0}, 0.0), {0.45 + builder.random().Uniform(0.0, 0.1), 0.7}, 1.45,
               &builder);
  }
  return builder.scene();
}

// Furniture as it is made in series, the front of which faces +y.
Scene MakeFurniture(uint64_t seed) {
  SceneBuilder builder(seed);
  AddBookcase(UprightFrame({-0.55, -0.3, 0}, 0.0), {1.0, 1.9}, &builder);
  AddTable(UprightFrame({0.6, 0.05, 0}, 0.0), {1.1, 0.6}, 0.74, &builder);
  AddClutter(UprightFrame({0.6, 0.05, 0}, 0.0), {0.9, 0.4}, 0.74, 6, &builder);
  return builder.scene();
}

// A hall with its exhibit, and a bookcase and a door behind those who look at it.
Scene MakeHall(const Scene& exhibit, const Placement& place, uint64_t seed, int index) {
  SceneBuilder builder(seed, 1 + index);
  Random& random = builder.random();
  const double x = random.Uniform(2.6, 4.2), y = random.Uniform(2.6, 4.2);
  const double height = random.Uniform(2.5, 3.2);
  const Texture floor = builder.NewTexture(TextureKind::kPlaster, {0.50f, 0.48f, 0.46f});
  const Texture white = builder.NewTexture(TextureKind::kPlain, {0.84f, 0.84f, 0.82f});
  builder.AddHall({-x, -y, 0}, {x, y, height}, floor, white, white);
  AddBookcase(UprightFrame({random.Uniform(-1.0, 1.0), y, 0}, kPi), {1.5, 1.8}, &builder);
  AddDoor(UprightFrame({x, random.Uniform(-1.0, 1.0), 0}, 0.5 * kPi), {0.9, 2.02},
          {0.66f, 0.55f, 0.42f}, &builder);
  AddCopy(exhibit, place, 0, &builder.scene());
  builder.scene().lights = {{{0, 0, height - 0.2}, 0.85, 2.6}};
  return builder.scene();
}

// Before the exhibit, with a look to either side.
std::vector<Step> VisitorSteps() {
  return {{-0.7, 1.7, -80}, {-0.3, 1.5, -85},  {0.2, 1.6, -95}, {0.7, 1.8, -100},
          {0.8, 1.9, -60},  {0.8, 2.0, -10},   {0.7, 2.0, -60}, {0.0, 1.9, -95},
          {-0.6, 1.9, -90}, {-0.7, 2.0, -130}, {-0.6, 1.8, -85}};
}

}  // namespace

Scene MakeGallery(uint64_t seed, const WalkOptions& walk) {
  const Scene exhibit = seed % 2 == 1 ? MakeBoard(seed) : MakeFurniture(seed);
  const int visited = static_cast<int>((walk.path - 1) % kNumHalls);
  TourWriter writer(seed, walk);
  Random random(seed, 100);
  Scene scene = MakeLookAlikeShell();
  for (int i = 0; i < kNumHalls; ++i) {
    const Rigid3 frame = UprightFrame({random.Uniform(-0.4, 0.4), random.Uniform(-1.0, -0.4), 0},
                                      random.Uniform(-0.6, 0.6));
    const Placement in_hall{frame.rotation().toRotationMatrix(), frame.translation()};
    const Eigen::Vector3d offset(i * kHallDistance, 0, 0);
    AddCopy(MakeHall(exhibit, in_hall, seed, i), {Eigen::Matrix3d::Identity(), offset}, i, &scene);
    scene.look_alikes.push_back({in_hall.linear, in_hall.offset + offset});
    if (i == visited) writer.Add(scene.look_alikes.back(), VisitorSteps());
  }
  scene.tour = writer.tour();
  return scene;
}

}  // namespace msc_vo
