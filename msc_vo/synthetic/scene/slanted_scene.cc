// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/synthetic/scene/furniture.h"
#include "msc_vo/synthetic/scene/scene_kinds.h"

namespace msc_vo {

namespace {

// A wall of a convex room: a rectangle through `point` with the given normal, much larger than the
// room. The parts outside the room are occluded by the other walls.
Quad WideWall(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Texture& texture) {
  const double half = 8.0;  // metres
  const Eigen::Vector3d n = normal.normalized();
  const Eigen::Vector3d guide =
      std::abs(n.z()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = guide.cross(n).normalized();
  const Eigen::Vector3d up = n.cross(right);
  return {point - half * (right + up), 2.0 * half * right, 2.0 * half * up, texture};
}

// Edges of the convex room enclosed by `walls`: the intersections of two planes, clipped by all the
// others.
std::vector<LineSegment3> ShellEdges(const std::vector<Quad>& walls) {
  std::vector<LineSegment3> edges;
  for (size_t i = 0; i < walls.size(); ++i) {
    for (size_t j = i + 1; j < walls.size(); ++j) {
      const Eigen::Vector3d a = walls[i].Normal(), b = walls[j].Normal(), along = a.cross(b);
      Eigen::Matrix3d planes;
      planes << a.transpose(), b.transpose(), along.transpose();
      const Eigen::Vector3d start =
          planes.inverse() * Eigen::Vector3d(a.dot(walls[i].origin), b.dot(walls[j].origin), 0.0);
      double low = -std::numeric_limits<double>::infinity(), high = -low;
      for (size_t k = 0; k < walls.size(); ++k) {
        if (k == i || k == j) continue;
        const double slope = walls[k].Normal().dot(along);
        const double s = walls[k].Normal().dot(walls[k].origin - start) / slope;
        (slope > 0.0 ? low : high) = slope > 0.0 ? std::max(low, s) : std::min(high, s);
      }
      const LineSegment3 edge{start + low * along, start + high * along};
      if (low < high && edge.Length() >= kMinEdge) edges.push_back(edge);
    }
  }
  return edges;
}

Eigen::Vector3d Heading(double degrees) {
  return {std::cos(DegreesToRadians(degrees)), std::sin(DegreesToRadians(degrees)), 0.0};
}

// Adds walls, no two of which are perpendicular, and two roof planes of different slopes.
void AddAtticShell(SceneBuilder* builder) {
  const Texture floor =
      builder->NewTexture(TextureKind::kPlanks, {0.55f, 0.40f, 0.26f}, {0.18f, 0.12f, 0.08f});
  const Texture plaster = builder->NewTexture(TextureKind::kPlaster, {0.84f, 0.82f, 0.76f});
  const Texture boards =
      builder->NewTexture(TextureKind::kPlanks, {0.74f, 0.58f, 0.40f}, {0.30f, 0.21f, 0.13f}, 1.4f);
  std::vector<Quad>& quads = builder->scene().quads;
  quads.push_back(WideWall({0, 0, 0}, {0.0, 0.0, 1.0}, floor));
  quads.push_back(WideWall({3.0, 0, 0}, -Heading(8.0) + Eigen::Vector3d(0, 0, 0.12), plaster));
  quads.push_back(WideWall({-3.0, 0, 0}, Heading(-13.0) + Eigen::Vector3d(0, 0, 0.08), plaster));
  quads.push_back(WideWall({0, -2.6, 0}, Heading(79.0), plaster));
  quads.push_back(WideWall({0, 2.6, 0}, -Heading(101.0), plaster));
  quads.push_back(WideWall({0, -0.2, 3.0}, {0.10, 0.80, -1.0}, boards));
  quads.push_back(WideWall({0, 0.2, 3.0}, {-0.12, -1.05, -1.0}, boards));
  builder->scene().edges = ShellEdges(quads);
}

// Adds a beam with a square cross-section.
void AddBeam(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double half,
             const Texture& texture, SceneBuilder* builder) {
  const Rigid3 frame(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), to - from), from);
  builder->AddBox(frame, {0, -half, -half}, {(to - from).norm(), half, half}, texture);
}

// Adds furniture at arbitrary angles, sloping beams and tilted boxes.
void FurnishAttic(SceneBuilder* builder) {
  Random& random = builder->random();
  const auto turned = [&](double x, double y, double degrees) {
    return UprightFrame({x, y, 0}, DegreesToRadians(degrees + random.Uniform(-9.0, 9.0)));
  };
  const Texture wood = builder->NewTexture(TextureKind::kWood, {0.50f, 0.35f, 0.22f});
  AddBookcase(turned(2.35, 0.9, 71.0), {1.2, 1.4}, builder);
  AddBookcase(turned(-2.45, -0.7, -64.0), {1.0, 1.3}, builder);
  AddCupboard(turned(-2.3, 0.9, -118.0), {1.1, 0.8}, 0.4, 2, wood, builder);
  AddCupboard(turned(0.9, -1.9, 27.0), {1.2, 0.7}, 0.4, 2, wood, builder);
  AddTable(turned(0.1, 0.1, 33.0), {1.2, 0.7}, 0.6, builder);
  AddChair(turned(0.9, 0.7, 152.0), builder);
  AddSofa(turned(0.4, 2.15, 163.0), 1.6, builder);
  AddRug(turned(-0.2, 0.0, 21.0), {2.2, 1.6}, builder);
  AddTable(turned(-1.3, 1.75, 52.0), {0.7, 0.5}, 0.5, builder);
  AddTable(turned(-0.9, -1.85, -38.0), {0.9, 0.5}, 0.55, builder);
  for (int i = 0; i < 4; ++i) {
    const double x = -1.9 + 1.25 * i + random.Uniform(-0.15, 0.15);
    AddBeam({x, -2.45, 1.0}, {x + 0.3, -0.45, 2.7}, 0.06, wood, builder);
    AddBeam({x + 0.1, 2.35, 0.5}, {x - 0.25, 0.65, 2.35}, 0.06, wood, builder);
  }
  for (int i = 0; i < 3; ++i) {  // tilted boxes
    const Texture print =
        builder->NewTexture(TextureKind::kPoster, {0.70f, 0.58f, 0.42f}, {0.3f, 0.2f, 0.1f}, 0.7f);
    const Rigid3 upright = turned(-1.2 + 1.4 * i, i % 2 == 0 ? -1.35 : 1.3, 40.0 * i);
    const Rigid3 lean({}, {0.0, 0.0, 0.1});
    const Rigid3 tilted(ExpSO3({0.25, 0.18 * (i - 1), 0.0}), lean.translation());
    builder->AddBox(upright * tilted, {-0.25, -0.2, 0}, {0.25, 0.2, 0.4}, print);
  }
}

}  // namespace

Scene MakeSlanted(uint64_t seed, const WalkOptions& /*walk*/) {
  SceneBuilder builder(seed);
  Random& random = builder.random();
  AddAtticShell(&builder);
  FurnishAttic(&builder);
  builder.scene().ambient = 0.36;
  builder.scene().lights = {{{-0.5, 0.2, 2.3}, 0.95, 2.5}, {{1.6, -0.4, 1.8}, 0.40, 2.0}};
  const int count = 9;
  for (int i = 0; i < count; ++i) {
    const double around = 2.0 * kPi * i / count, ahead = around + DegreesToRadians(75.0);
    builder.AddWaypoint(
        {1.15 * std::cos(around), 0.65 * std::sin(around), 1.35 + random.Uniform(-0.1, 0.1)},
        {2.9 * std::cos(ahead), 2.5 * std::sin(ahead), random.Uniform(0.7, 1.2)});
  }
  return builder.scene();
}

}  // namespace msc_vo
