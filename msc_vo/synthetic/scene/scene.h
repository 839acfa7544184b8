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
  int zone = 0;  ///< the lights of the same zone light it

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
  /// Surfaces cast no shadows: a light shines through the walls of its zone, but not beyond.
  int zone = 0;
};

/// A mirror, a pane of glass or a polished surface. Its depth is that of its face; its colour is
/// reflectance * (mirror image) + transmittance * (what is behind) + color.
struct SpecularSurface {
  Quad face;                                        ///< its texture is ignored
  double reflectance = 0.0;                         ///< 0 to 1
  double transmittance = 0.0;                       ///< 0 to 1
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  ///< red, green, blue, 0 to 1, lit
};

/// A camera position of a tour, which the spline approximates, and the point that the camera
/// points at. Metres, world frame.
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

/// Where a part of a scene is repeated: x_in_world = linear * x_in_part + offset.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< rotation, or reflection
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();      ///< metres
};

/// Which walk through a scene its tour is.
struct WalkOptions {
  /// Number of the walk, from 1. Other numbers give other walks through the same surfaces.
  uint64_t path = 1;
  /// Of scenes with places that look alike: the walk comes back to one of them.
  bool returns = false;
};

/// A scene of textured rectangles; z is up.
struct Scene {
  std::vector<Quad> quads;
  std::vector<SpecularSurface> specular;  ///< a nearer one follows those that it may cover
  std::vector<PointLight> lights;
  double ambient = 0.35;  ///< brightness without any light
  /// Daylight from one side: surfaces with a normal n have the ambient brightness times
  /// 1 + n . daylight, so that the faces of a white box differ.
  Eigen::Vector3f daylight{0.30f, 0.16f, 0.22f};
  std::vector<LineSegment3> edges;  ///< edges of walls and boxes, metres, at least kMinEdge long
  std::vector<Waypoint> tour;       ///< path through free space
  bool tour_is_loop = true;         ///< else, it ends at its last waypoint
  /// The places that look alike, as copies of one part; in odd seeds, each has a small object of
  /// its own, except in a gallery.
  std::vector<Placement> look_alikes;

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
  // Places, or in a gallery things, that look alike; the tour is no loop.
  kRooms,     ///< identical rooms along a corridor
  kMirrored,  ///< rooms that mirror each other across a corridor and along it
  kFloors,    ///< two identical floors, connected by a lift shaft
  kDesks,     ///< identical desks with identical objects in one hall
  kGallery,   ///< two halls of different shapes with the same board of pictures, or furniture
  // Blank surfaces, which points and lines hardly hold.
  kBlank,    ///< a room of walls, floor and ceiling, nothing else
  kZigZag,   ///< zigzag walls so close that the image shows little else
  kDeadEnd,  ///< a corridor that is walked towards its blank end
  kPoster,   ///< a blank wall with one poster
};

/// The names of all kinds, in their order: "room", "corridor", ...
const std::vector<std::string>& SceneKindNames();
/// The kind with this name; std::nullopt if there is none.
std::optional<SceneKind> SceneKindFromName(const std::string& name);

/// True if a walk through a scene of this kind can return to the first of its places that look
/// alike.
bool SupportsReturns(SceneKind kind);

/// Builds a scene. Deterministic; the seed determines sizes, colours and furniture, and with `walk`
/// the tour.
Scene MakeScene(SceneKind kind, uint64_t seed, const WalkOptions& walk = {});

}  // namespace msc_vo
