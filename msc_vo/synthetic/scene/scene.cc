// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/scene.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "msc_vo/synthetic/scene/scene_kinds.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

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
  static const std::vector<std::string> names = {
      "room",   "corridor", "bare",    "slanted", "house",  "box",      "rooms", "mirrored",
      "floors", "desks",    "gallery", "blank",   "zigzag", "dead-end", "poster"};
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

namespace {

Scene MakeWithTour(SceneKind kind, uint64_t seed, const WalkOptions& walk) {
  switch (kind) {
    case SceneKind::kRoom:
      return MakeRoom(seed);
    case SceneKind::kCorridor:
      return MakeCorridor(seed);
    case SceneKind::kBare:
      return MakeBare(seed);
    case SceneKind::kSlanted:
      return MakeSlanted(seed);
    case SceneKind::kHouse:
      return MakeHouse(seed);
    case SceneKind::kBox:
      return MakeBox(seed);
    case SceneKind::kRooms:
      return MakeRooms(seed, walk);
    case SceneKind::kMirrored:
      return MakeMirrored(seed, walk);
    case SceneKind::kFloors:
      return MakeFloors(seed, walk);
    case SceneKind::kDesks:
      return MakeDesks(seed, walk);
    case SceneKind::kGallery:
      return MakeGallery(seed, walk);
    case SceneKind::kBlank:
      return MakeBlank(seed);
    case SceneKind::kZigZag:
      return MakeZigZag(seed);
    case SceneKind::kDeadEnd:
      return MakeDeadEnd(seed);
    case SceneKind::kPoster:
      return MakePoster(seed);
  }
  return {};
}

}  // namespace

Scene MakeScene(SceneKind kind, uint64_t seed, const WalkOptions& walk) {
  Scene scene = MakeWithTour(kind, seed, walk);
  if (scene.tour_is_loop && walk.path != 1) scene.tour = OtherTour(scene, seed, walk.path);
  return scene;
}

}  // namespace msc_vo
