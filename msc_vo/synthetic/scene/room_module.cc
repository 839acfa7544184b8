// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/room_module.h"

#include "msc_vo/synthetic/scene/furniture.h"

namespace msc_vo {

namespace {

constexpr double kRightAngle = 0.5 * kPi;
const Eigen::Vector3f kRoomPaint(0.86f, 0.84f, 0.78f);
const Eigen::Vector3f kCupboardWood(0.62f, 0.44f, 0.27f);

Rigid3 Along(const Rigid3& frame, double x) { return frame * Rigid3({1, 0, 0, 0}, {x, 0, 0}); }

// Adds the front wall with its two doorways.
void AddFrontWall(const RoomPlan& plan, const Texture& paint, SceneBuilder* builder) {
  std::vector<Quad>& quads = builder->scene().quads;
  const size_t first = quads.size();
  const double end = 0.5 * plan.pitch, low = plan.door - plan.half_door;
  const double high = plan.door + plan.half_door;
  const auto add = [&](double x_low, double x_high, double z) {
    builder->AddBox(Rigid3(), {x_low, -plan.wall, z}, {x_high, 0, plan.height}, paint);
  };
  add(-end, -high, 0.0);
  add(-low, low, 0.0);
  add(high, end, 0.0);
  add(-high, -low, plan.lintel);
  add(low, high, plan.lintel);
  for (size_t i = first; i < quads.size(); ++i) {
    if (quads[i].Normal().y() < -0.5) quads[i].zone = quads[i].At(0.5, 0.5).x() < 0.0 ? -2 : 1;
  }
}

// Adds furniture of little depth, centred at the origin of `frame`.
void FurnishSide(const Rigid3& frame, SceneBuilder* builder) {
  switch (builder->random().Index(3)) {
    case 0:
      AddBookcase(Along(frame, -0.1), {1.5, 2.0}, builder);
      return;
    case 1: {
      const Texture oak = builder->NewTexture(TextureKind::kWood, kCupboardWood);
      AddCupboard(frame, {1.6, 0.9}, 0.4, 3, oak, builder);
      AddClutter(frame * Rigid3({1, 0, 0, 0}, {0, 0.2, 0}), {1.3, 0.3}, 0.9, 4, builder);
      AddPicture(Along(frame, 0.2), {0.9, 0.65}, 1.65, builder);
      return;
    }
    default:
      AddBookcase(Along(frame, 0.55), {0.9, 1.8}, builder);
      AddPicture(Along(frame, -0.6), {0.8, 0.6}, 1.5, builder);
      return;
  }
}

// Adds furniture along the wall opposite to the doors.
void FurnishBack(const Rigid3& frame, SceneBuilder* builder) {
  switch (builder->random().Index(3)) {
    case 0:
      AddCounter(frame, 2.4, builder);
      return;
    case 1:
      AddSofa(frame, 2.0, builder);
      AddPicture(Along(frame, -0.5), {0.8, 0.6}, 1.6, builder);
      AddPicture(Along(frame, 0.6), {0.6, 0.8}, 1.6, builder);
      return;
    default:
      AddTable(frame * Rigid3({1, 0, 0, 0}, {0.5, 0.4, 0}), {1.5, 0.65}, 0.74, builder);
      AddWindow(Along(frame, 0.5), {1.4, 1.1}, 1.15, builder);
      AddPicture(Along(frame, -0.85), {0.7, 0.9}, 1.5, builder);
      return;
  }
}

}  // namespace

RoomPlan DrawRoomPlan(Random* random) {
  RoomPlan plan;
  plan.width += random->Uniform(-0.1, 0.3);
  plan.depth += random->Uniform(-0.1, 0.3);
  plan.pitch = plan.width + 0.1;
  return plan;
}

Scene MakeRoomModule(const RoomPlan& plan, uint64_t seed) {
  SceneBuilder builder(seed);
  const double x = 0.5 * plan.width;
  const Texture floor =
      builder.random().Uniform() < 0.5
          ? builder.NewTexture(TextureKind::kPlanks, {0.62f, 0.45f, 0.28f}, {0.22f, 0.15f, 0.10f})
          : builder.NewTexture(TextureKind::kTiles, {0.60f, 0.58f, 0.55f}, {0.30f, 0.30f, 0.30f},
                               1.6f);
  const Texture ceiling = builder.NewTexture(TextureKind::kPlaster, {0.9f, 0.9f, 0.88f});
  const Texture paint = builder.NewTexture(TextureKind::kPlaster, kRoomPaint);
  builder.AddHall({-x, -plan.wall, 0}, {x, plan.depth, plan.height}, floor, ceiling, paint);
  std::vector<Quad>& quads = builder.scene().quads;
  quads.erase(quads.begin() + 3);  // faces +y: the front wall stands there
  AddFrontWall(plan, paint, &builder);
  builder.scene().lights = {{{0, 0.5 * plan.depth, plan.height - 0.3}, 0.85, 2.4}};
  AddCeilingLamp(UprightFrame({0, 0.5 * plan.depth, plan.height}, 0.0), {0.5, 0.5}, &builder);
  FurnishBack(UprightFrame({0, plan.depth, 0}, 2.0 * kRightAngle), &builder);
  for (const double side : {-1.0, 1.0}) {
    const auto frame = [&](double y) { return UprightFrame({side * x, y, 0}, side * kRightAngle); };
    FurnishSide(frame(0.5 * plan.depth + 0.1), &builder);
    AddPicture(frame(0.5), {0.5, 0.7}, 1.4, &builder);  // where a camera turns to the door
  }
  AddPicture(UprightFrame({-0.15, 0, 0}, 0.0), {0.5, 0.7}, 1.5, &builder);
  return builder.scene();
}

Scene MakeRoomMark(uint64_t seed) {
  SceneBuilder builder(seed);
  AddPicture(UprightFrame({0.4, 0, 0}, 0.0), {0.22, 0.3}, 1.5, &builder);
  return builder.scene();
}

Scene MakeLookAlikeShell() {
  Scene scene;
  scene.ambient = 0.38;
  scene.daylight = {0.0f, 0.0f, 0.22f};
  scene.tour_is_loop = false;
  return scene;
}

void AddCopy(const Scene& part, const Placement& placement, int zone, Scene* scene) {
  const Eigen::Matrix3d& linear = placement.linear;
  const bool is_mirrored = linear.determinant() < 0.0;
  const auto point = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(linear * x + placement.offset);
  };
  for (Quad quad : part.quads) {
    // The visible side of a reflected rectangle remains that of edge_u x edge_v if one edge is
    // reversed.
    quad.origin = point(is_mirrored ? quad.At(1, 0) : quad.origin);
    quad.edge_u = (is_mirrored ? -1.0 : 1.0) * (linear * quad.edge_u);
    quad.edge_v = linear * quad.edge_v;
    quad.texture.mirrored = quad.texture.mirrored != is_mirrored;
    quad.zone += zone;
    scene->quads.push_back(quad);
  }
  for (PointLight light : part.lights) {
    light.position = point(light.position);
    light.zone += zone;
    scene->lights.push_back(light);
  }
  for (const LineSegment3& edge : part.edges) {
    scene->edges.push_back({point(edge.start), point(edge.end)});
  }
}

}  // namespace msc_vo
