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

/// Shortest edge that is listed, metres: shorter ones are not detected at some metres.
constexpr double kMinEdge = 0.15;

/// A textured rectangle, visible from the side that its normal edge_u x edge_v points to. Metres,
/// world frame.
struct Quad {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d edge_u = Eigen::Vector3d::UnitX();  ///< perpendicular to edge_v
  Eigen::Vector3d edge_v = Eigen::Vector3d::UnitY();
  Texture texture;

  Eigen::Vector3d Normal() const { return edge_u.cross(edge_v).normalized(); }
  double Area() const { return edge_u.norm() * edge_v.norm(); }
  Eigen::Vector3d At(double u, double v) const { return origin + u * edge_u + v * edge_v; }
  /// Distance of a point from the rectangle, metres.
  double Distance(const Eigen::Vector3d& x_in_world) const;
};

struct PointLight {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world frame
  double intensity = 1.0;  ///< brightness of a white surface close to the light and facing it
  double reach = 3.0;      ///< distance of half that brightness, metres
};

/// A camera position of a tour, which the spline approximates, and the point that the camera
/// points at. Metres, world frame.
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

/// A scene of textured rectangles; z is up.
struct Scene {
  std::vector<Quad> quads;
  std::vector<PointLight> lights;
  double ambient = 0.35;            ///< brightness without any light
  std::vector<LineSegment3> edges;  ///< edges of walls and boxes, metres, at least kMinEdge long
  std::vector<Waypoint> tour;       ///< closed loop through free space

  /// The straight edges that textures draw on the rectangles (TextureEdges), metres, at least
  /// kMinEdge long.
  std::vector<LineSegment3> PaintedEdges() const;
  /// Distance to the nearest surface, metres.
  double Clearance(const Eigen::Vector3d& x_in_world) const;
  /// Returns s of the first point origin + s * direction on a surface that faces the origin;
  /// std::nullopt if there is none.
  std::optional<double> CastRay(const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction) const;
};

enum class SceneKind {
  kRoom,      ///< furnished, rich texture, Manhattan
  kCorridor,  ///< long plain walls, doors, skirting boards: few points, many lines, Manhattan
  kBare,      ///< white boxes and zigzag walls: shading only
  kSlanted,   ///< attic with sloped walls and furniture at arbitrary angles: no Manhattan frame
  kHouse,     ///< four furnished rooms connected in a ring: for long trajectories, Manhattan
  kBox,       ///< an orbit around one box on a plain floor, crates far off: few lines
};

/// "room", "corridor", "bare", "slanted", "house" or "box"; std::nullopt for any other name.
std::optional<SceneKind> SceneKindFromName(const std::string& name);

/// Builds a scene. Deterministic; the seed determines sizes, colours and furniture.
Scene MakeScene(SceneKind kind, uint64_t seed);

}  // namespace msc_vo
