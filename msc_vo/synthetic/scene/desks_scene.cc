// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

namespace {

constexpr double kPitch = 2.3, kDepth = 2.9, kOfficeHeight = 2.8;  // of the place of a desk, metres
constexpr double kEndBay = 1.2;  // length of the hall beyond the desks, metres
const Eigen::Vector3f kOfficePaint(0.84f, 0.84f, 0.80f);

// A desk with its part of the hall, from the aisle at y = 0 to the wall behind the desk.
Scene MakeDeskPlace(uint64_t seed) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  const double x = 0.5 * kPitch;
  const Texture floor =
      builder.NewTexture(TextureKind::kSpeckle, {0.38f, 0.40f, 0.44f}, {0.22f, 0.24f, 0.28f}, 4.0f);
  const Texture ceiling = builder.NewTexture(TextureKind::kPlain, {0.9f, 0.9f, 0.9f});
  const Texture paint = builder.NewTexture(TextureKind::kPlaster, kOfficePaint);
  builder.AddQuad({{-x, 0, 0}, {2 * x, 0, 0}, {0, kDepth, 0}, floor});
  builder.AddQuad({{x, 0, kOfficeHeight}, {-2 * x, 0, 0}, {0, kDepth, 0}, ceiling});
  builder.AddQuad({{-x, kDepth, 0}, {2 * x, 0, 0}, {0, 0, kOfficeHeight}, paint});

  const double desk = 1.75 + random.Uniform(-0.05, 0.05);
  const Rigid3 facing_aisle = UprightFrame({0, desk, 0}, kPi);
  AddTable(facing_aisle, {1.5, 0.7}, 0.74, &builder);
  const Texture black = builder.NewTexture(TextureKind::kPlain, {0.12f, 0.12f, 0.12f});
  const Texture screen =
      builder.NewTexture(TextureKind::kPoster, {0.3f, 0.4f, 0.6f}, {0.1f, 0.1f, 0.1f}, 0.5f);
  const double at = random.Uniform(-0.3, 0.3);
  builder.AddBox(facing_aisle, {at - 0.27, -0.33, 0.85}, {at + 0.27, -0.28, 1.2}, black, &screen);
  AddChair(UprightFrame({random.Uniform(-0.25, 0.25), desk - 0.62, 0}, random.Uniform(-0.5, 0.5)),
           &builder);
  const Texture fabric =
      builder.NewTexture(TextureKind::kSpeckle, {0.45f, 0.5f, 0.55f}, {0.2f, 0.2f, 0.25f}, 2.0f);
  builder.AddBox(UprightFrame({0, desk + 0.45, 0}, kPi), {-0.95, 0, 0}, {0.95, 0.04, 1.35}, fabric);
  AddPicture(UprightFrame({random.Uniform(-0.3, 0.1), kDepth, 0}, kPi), {0.9, 0.6}, 1.85, &builder);
  AddCeilingLamp(UprightFrame({0, 0.5 * kDepth, kOfficeHeight}, 0.0), {1.2, 0.3}, &builder);
  builder.scene().lights = {{{0, 0.5 * kDepth, kOfficeHeight - 0.3}, 0.85, 2.2}};
  return builder.scene();
}

// A note on the wall, with which a desk differs from others.
Scene MakeDeskMark(uint64_t seed) {
  SceneBuilder builder(seed);
  AddPicture(UprightFrame({0.75, kDepth, 0}, kPi), {0.22, 0.3}, 1.75, &builder);
  return builder.scene();
}

// The ends of the hall, in front of the first and behind the last desks.
Scene MakeEndBays(uint64_t seed, double half_length) {
  SceneBuilder builder(seed, 1);
  const Texture floor = builder.NewTexture(TextureKind::kPlaster, {0.42f, 0.44f, 0.46f});
  const Texture plain = builder.NewTexture(TextureKind::kPlain, {0.9f, 0.9f, 0.9f});
  const Texture paint = builder.NewTexture(TextureKind::kPlaster, kOfficePaint);
  const double end = half_length + kEndBay;
  for (const double side : {-1.0, 1.0}) {
    SceneBuilder bay(seed, side > 0.0 ? 2 : 3);
    bay.AddHall({std::min(side * half_length, side * end), -kDepth, 0},
                {std::max(side * half_length, side * end), kDepth, kOfficeHeight}, floor, plain,
                paint);
    // Without the side towards the desks: index 0 faces -x, index 1 +x.
    std::vector<Quad>& quads = bay.scene().quads;
    quads.erase(quads.begin() + (side > 0.0 ? 1 : 0));
    AddDoor(UprightFrame({side * end, -1.4, 0}, side * 0.5 * kPi), {0.9, 2.02},
            {0.66f, 0.55f, 0.42f}, &bay);
    for (const double y : {-0.4, 0.6, 1.6}) {
      AddPicture(UprightFrame({side * end, y, 0}, side * 0.5 * kPi), {0.6, 0.8}, 1.5, &bay);
    }
    AddCopy(bay.scene(), {}, 0, &builder.scene());
  }
  builder.scene().lights = {{{half_length, 0, kOfficeHeight - 0.3}, 0.7, 2.2},
                            {{-half_length, 0, kOfficeHeight - 0.3}, 0.7, 2.2}};
  return builder.scene();
}

// The walk along one row with a view of its desks, and the turn to the other row.
std::vector<Step> RowSteps(int num_desks) {
  const double end = 0.5 * (num_desks - 1) * kPitch;
  std::vector<Step> steps;
  const int count = 3 * (num_desks - 1);
  for (int i = 0; i <= count; ++i) {
    const double lean = i % 3 == 1 ? 12.0 : (i % 3 == 2 ? -12.0 : 0.0);
    steps.push_back({-end + 2.0 * end * i / count, 0.0, 90.0 + lean});
  }
  steps.push_back({end + 0.35, 0.0, 50});
  steps.push_back({end + 0.5, 0.0, 0});
  steps.push_back({end + 0.35, 0.0, -50});
  return steps;
}

}  // namespace

Scene MakeDesks(uint64_t seed, const WalkOptions& walk) {
  Random random(seed);
  const int num_desks = 2 + random.Index(2);  // of a row
  const double half_length = 0.5 * num_desks * kPitch;
  Scene scene = MakeLookAlikeShell();
  std::vector<Placement> placements;
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < num_desks; ++i) {
      placements.push_back({Eigen::Vector3d(side, side, 1.0).asDiagonal(),
                            {side * ((i + 0.5) * kPitch - half_length), 0, 0}});
    }
  }
  AddLookAlikes(MakeDeskPlace(seed), placements, 1, seed, MakeDeskMark, &scene);
  AddCopy(MakeEndBays(seed, half_length), {}, static_cast<int>(placements.size()), &scene);

  TourWriter writer(seed, walk);
  const Placement row, other_row{Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal(), {0, 0, 0}};
  const std::vector<Step> steps = RowSteps(num_desks);
  writer.Add(row, steps);
  if (walk.returns) {
    writer.Add(other_row, steps);
    writer.Add(row, {steps.begin(), steps.begin() + 3});
  } else {
    writer.Add(other_row, {steps.begin(), steps.end() - 3});
  }
  scene.tour = writer.tour();
  return scene;
}

}  // namespace msc_vo
