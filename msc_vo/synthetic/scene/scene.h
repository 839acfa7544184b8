// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/synthetic/scene/texture.h"

namespace msc_vo {

// Shorter edges do not make a segment that a detector would keep at some metres.
constexpr double kMinEdge = 0.15;  // metres

// A textured rectangle, seen from the side that its normal edge_u x edge_v points to; metres,
// world.
struct Quad {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d edge_u = Eigen::Vector3d::UnitX();  // perpendicular to edge_v
  Eigen::Vector3d edge_v = Eigen::Vector3d::UnitY();
  Texture texture;

  Eigen::Vector3d Normal() const { return edge_u.cross(edge_v).normalized(); }
  double Area() const { return edge_u.norm() * edge_v.norm(); }
  Eigen::Vector3d At(double u, double v) const { return origin + u * edge_u + v * edge_v; }
  // Distance of a point to the rectangle, metres.
  double Distance(const Eigen::Vector3d& x_in_world) const;
};

struct PointLight {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
  double intensity = 1.0;  // brightness of a white face that looks at it from nearby
  double reach = 3.0;      // metres, where a face gets half of that
};

// A place that a tour passes (nearly), and what the camera looks at there; metres, world.
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

// A world of rectangles, z up.
struct Scene {
  std::vector<Quad> quads;
  std::vector<PointLight> lights;
  double ambient = 0.35;            // brightness where no light falls
  std::vector<LineSegment3> edges;  // of walls and boxes, metres, kMinEdge at least
  std::vector<Waypoint> tour;       // closed loop through free space

  // The straight edges that textures paint on the rectangles (TextureEdges), metres, kMinEdge at
  // least.
  std::vector<LineSegment3> PaintedEdges() const;
  // Distance to the nearest surface, metres.
  double Clearance(const Eigen::Vector3d& x_in_world) const;
  // Distance along origin + s * direction to the first surface that faces the origin, in units of
  // `direction`; std::nullopt if there is none.
  std::optional<double> CastRay(const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const;
};

enum class SceneKind {
  kRoom,      // furnished, much texture, Manhattan
  kCorridor,  // long plain walls, doors, skirting boards: few points, many lines, Manhattan
  kBare,      // white boxes and zig-zag walls: shading only
  kSlanted,   // attic with sloped walls and furniture at odd angles: no Manhattan frame
  kHouse,     // four furnished rooms in a ring, joined by doorways: for long walks, Manhattan
};

// "room", "corridor", "bare", "slanted", "house"; std::nullopt for any other name.
std::optional<SceneKind> SceneKindFromName(const std::string& name);

// The same kind and seed give the same scene; other seeds vary sizes, colours and furniture.
Scene MakeScene(SceneKind kind, uint64_t seed);

}  // namespace msc_vo
