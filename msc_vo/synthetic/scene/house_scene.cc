// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

constexpr double kHalfX = 5.0, kHalfY = 4.4, kHouseHeight = 2.6;  // half size of the house, metres
constexpr double kWall = 0.06;                                    // half thickness of a partition
constexpr double kDoorway = 0.55, kLintel = 2.1;                  // half width and height, metres

// Adds a partition in the plane y = 0 of `frame`, along `span`, with a doorway centred at `door`.
void AddPartition(const Rigid3& frame, const Span& span, double door, const Texture& paint,
                  SceneBuilder* builder) {
  builder->AddBox(frame, {span.low, -kWall, 0}, {door - kDoorway, kWall, kHouseHeight}, paint);
  builder->AddBox(frame, {door + kDoorway, -kWall, 0}, {span.high, kWall, kHouseHeight}, paint);
  builder->AddBox(frame, {door - kDoorway, -kWall, kLintel}, {door + kDoorway, kWall, kHouseHeight},
                  paint);
}

// Furnishes one of the four rooms. The signs of the coordinates of `center` tell on which sides its
// outer walls are.
void FurnishQuarter(const Eigen::Vector2d& center, int index, SceneBuilder* builder) {
  const double side_x = center.x() > 0.0 ? 1.0 : -1.0, side_y = center.y() > 0.0 ? 1.0 : -1.0;
  const Rigid3 outer_x =
      UprightFrame({side_x * kHalfX, center.y(), 0}, side_x > 0.0 ? 0.5 * kPi : -0.5 * kPi);
  const Rigid3 outer_y = UprightFrame({center.x(), side_y * kHalfY, 0}, side_y > 0.0 ? kPi : 0.0);
  const auto along = [](const Rigid3& frame, double x) {
    return frame * Rigid3({1, 0, 0, 0}, {x, 0, 0});
  };
  if (index == 0) {
    AddCounter(outer_x, 2.6, builder);
    AddWindow(outer_y, {1.6, 1.2}, 1.0, builder);
  } else if (index == 1) {
    AddBookcase(along(outer_x, -0.9), {1.5, 2.0}, builder);
    AddBookcase(along(outer_x, 0.8), {1.2, 1.7}, builder);
    AddSofa(outer_y, 2.1, builder);
    AddPicture(outer_y, {1.1, 0.7}, 1.6, builder);
  } else if (index == 2) {
    const Texture oak = builder->NewTexture(TextureKind::kWood, {0.62f, 0.44f, 0.27f});
    AddCupboard(outer_x, {2.2, 1.1}, 0.5, 4, oak, builder);
    AddPicture(outer_x, {0.9, 0.7}, 1.75, builder);
    AddTable(along(outer_y, 0.3) * Rigid3({1, 0, 0, 0}, {0, 0.4, 0}), {1.6, 0.7}, 0.74, builder);
    AddWindow(outer_y, {1.6, 1.2}, 0.95, builder);
  } else {
    AddSofa(outer_x, 2.0, builder);
    AddPicture(along(outer_x, 0.5), {0.7, 0.9}, 1.6, builder);
    AddBookcase(along(outer_y, -0.7), {1.4, 2.0}, builder);
    AddPicture(along(outer_y, 0.9), {0.8, 0.6}, 1.5, builder);
  }
  AddRug(UprightFrame({center.x(), center.y(), 0}, 0.0), {1.9, 1.5}, builder);
  AddTable(UprightFrame({center.x(), center.y(), 0.008}, 0.0), {0.9, 0.6}, 0.5, builder);
  AddCeilingLamp(UprightFrame({center.x(), center.y(), kHouseHeight}, 0.0), {0.5, 0.5}, builder);
  builder->scene().lights.push_back({{center.x(), center.y(), kHouseHeight - 0.3}, 0.85, 2.4});
}

// Adds pictures on both sides of the partitions, away from the doorways.
void HangPictures(SceneBuilder* builder) {
  for (const double sign : {-1.0, 1.0}) {
    for (const double way : {-1.0, 1.0}) {
      const double facing_y = way > 0.0 ? 0.0 : kPi, facing_x = way > 0.0 ? -0.5 * kPi : 0.5 * kPi;
      AddPicture(UprightFrame({sign * 0.8, way * kWall, 0}, facing_y), {0.7, 0.5}, 1.5, builder);
      AddPicture(UprightFrame({sign * 4.1, way * kWall, 0}, facing_y), {0.6, 0.8}, 1.5, builder);
      AddPicture(UprightFrame({way * kWall, sign * 0.7, 0}, facing_x), {0.6, 0.5}, 1.5, builder);
      AddPicture(UprightFrame({way * kWall, sign * 3.6, 0}, facing_x), {0.8, 0.6}, 1.5, builder);
    }
  }
}

// Adds a tour through the four doorways, counterclockwise, around the table of each room.
void AddRoundTrip(SceneBuilder* builder) {
  Random& random = builder->random();
  const double x = 0.5 * kHalfX, y = 0.5 * kHalfY;
  const std::vector<Eigen::Vector2d> way = {{x, -1.0},  {x, 0.0},  {x, 1.0},   {x - 0.3, y},
                                            {1.0, y},   {0.0, y},  {-1.0, y},  {-x + 0.3, y},
                                            {-x, 1.0},  {-x, 0.0}, {-x, -1.0}, {-x + 0.3, -y},
                                            {-1.0, -y}, {0.0, -y}, {1.0, -y},  {x - 0.3, -y}};
  const size_t count = way.size();
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d ahead = way[(i + 2) % count] - way[i];
    const Eigen::Vector2d out = way[i].normalized();
    const Eigen::Vector2d look = way[i] + 1.6 * ahead.normalized() + 0.9 * out;
    builder->AddWaypoint({way[i].x(), way[i].y(), 1.45 + random.Uniform(-0.08, 0.08)},
                         {look.x(), look.y(), random.Uniform(1.0, 1.3)});
  }
}

}  // namespace

Scene MakeHouse(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  const Texture floor =
      builder.NewTexture(TextureKind::kPlanks, {0.62f, 0.45f, 0.28f}, {0.22f, 0.15f, 0.10f});
  const Texture ceiling = builder.NewTexture(TextureKind::kPlaster, {0.9f, 0.9f, 0.88f});
  const Texture paint = builder.NewTexture(TextureKind::kPlaster, {0.86f, 0.84f, 0.78f});
  builder.AddHall({-kHalfX, -kHalfY, 0}, {kHalfX, kHalfY, kHouseHeight}, floor, ceiling, paint);
  builder.scene().ambient = 0.36;
  const double x = 0.5 * kHalfX, y = 0.5 * kHalfY;
  const Rigid3 along_x = UprightFrame({0, 0, 0}, 0.0), along_y = UprightFrame({0, 0, 0}, 0.5 * kPi);
  AddPartition(along_x, {-kHalfX, -kWall}, -x, paint, &builder);
  AddPartition(along_x, {kWall, kHalfX}, x, paint, &builder);
  AddPartition(along_y, {-kHalfY, -kWall}, -y, paint, &builder);
  AddPartition(along_y, {kWall, kHalfY}, y, paint, &builder);
  const std::vector<Eigen::Vector2d> centers = {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
  for (int i = 0; i < 4; ++i) FurnishQuarter(centers[i], i, &builder);
  HangPictures(&builder);
  AddRoundTrip(&builder);
  return builder.scene();
}

}  // namespace msc_vo
