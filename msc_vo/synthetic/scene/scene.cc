// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/scene.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <Eigen/Geometry>

#include "msc_vo/synthetic/scene/scene_kinds.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

namespace {

struct NamedScene {
  const char* name;
  Scene (*make)(uint64_t seed, const WalkOptions& walk);
};

// In the order of SceneKind.
constexpr NamedScene kScenes[] = {
    {"room", MakeRoom},       {"corridor", MakeCorridor}, {"bare", MakeBare},
    {"slanted", MakeSlanted}, {"house", MakeHouse},       {"box", MakeBox},
    {"rooms", MakeRooms},     {"mirrored", MakeMirrored}, {"floors", MakeFloors},
    {"desks", MakeDesks},     {"gallery", MakeGallery},   {"blank", MakeBlank},
    {"zigzag", MakeZigZag},   {"dead-end", MakeDeadEnd},  {"poster", MakePoster}};
static_assert(std::size(kScenes) == static_cast<size_t>(SceneKind::kPoster) + 1);

}  // namespace

double Quad::Distance(const Eigen::Vector3d& x_in_world) const {
  const Eigen::Vector3d d = x_in_world - origin;
  const double u = std::clamp(d.dot(edge_u) / edge_u.squaredNorm(), 0.0, 1.0);
  const double v = std::clamp(d.dot(edge_v) / edge_v.squaredNorm(), 0.0, 1.0);
  return (x_in_world - At(u, v)).norm();
}

std::vector<LineSegment3> Scene::PaintedEdges() const {
  std::vector<LineSegment3> painted;
  for (const Quad& quad : quads) {
    const double width = quad.edge_u.norm(), height = quad.edge_v.norm();
    const auto at = [&](const Eigen::Vector2d& x) {
      return quad.At(x.x() / width, x.y() / height);
    };
    for (const LineSegment2& edge :
         TextureEdges(quad.texture, static_cast<float>(width), static_cast<float>(height))) {
      if (edge.Length() >= kMinEdge) painted.push_back({at(edge.start), at(edge.end)});
    }
  }
  return painted;
}

double Scene::Clearance(const Eigen::Vector3d& x_in_world) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Quad& quad : quads) nearest = std::min(nearest, quad.Distance(x_in_world));
  for (const SpecularSurface& s : specular) {
    nearest = std::min(nearest, s.face.Distance(x_in_world));
  }
  return nearest;
}

std::optional<double> Scene::CastRay(const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) const {
  std::optional<double> nearest;
  for (const Quad& quad : quads) {
    const Eigen::Vector3d normal = quad.edge_u.cross(quad.edge_v);
    const double approach = normal.dot(direction);
    if (approach >= 0.0) continue;  // faces away from the origin
    const double s = normal.dot(quad.origin - origin) / approach;
    if (s <= 0.0 || (nearest && s >= *nearest)) continue;
    const Eigen::Vector3d d = origin + s * direction - quad.origin;
    const double u = d.dot(quad.edge_u) / quad.edge_u.squaredNorm();
    const double v = d.dot(quad.edge_v) / quad.edge_v.squaredNorm();
    if (u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0) nearest = s;
  }
  return nearest;
}

const std::vector<std::string>& SceneKindNames() {
  static const auto names = [] {
    std::vector<std::string> all;
    for (const NamedScene& scene : kScenes) all.emplace_back(scene.name);
    return all;
  }();
  return names;
}

std::optional<SceneKind> SceneKindFromName(const std::string& name) {
  const std::vector<std::string>& names = SceneKindNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<SceneKind>(found - names.begin());
}

bool SupportsReturns(SceneKind kind) {
  return kind == SceneKind::kRooms || kind == SceneKind::kMirrored || kind == SceneKind::kFloors ||
         kind == SceneKind::kDesks;
}

Scene MakeScene(SceneKind kind, uint64_t seed, const WalkOptions& walk) {
  Scene scene = kScenes[static_cast<size_t>(kind)].make(seed, walk);
  if (scene.tour_is_loop && walk.path != 1) scene.tour = OtherTour(scene, seed, walk.path);
  return scene;
}

}  // namespace msc_vo
