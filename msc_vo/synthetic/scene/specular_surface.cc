// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/specular_surface.h"

#include <algorithm>

#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

namespace {

// Rectangles closer than this to the plane of a mirror, metres, are the wall that it hangs on.
constexpr double kWallDistance = 0.1;

// Half the size of the floor, the largest rectangle that faces upwards, metres; its centre is the
// origin.
Eigen::Vector2d HalfSize(const Scene& room) {
  const Quad* floor = nullptr;
  for (const Quad& quad : room.quads) {
    if (quad.Normal().z() > 0.99 && (floor == nullptr || quad.Area() > floor->Area())) {
      floor = &quad;
    }
  }
  if (floor == nullptr) return Eigen::Vector2d::Zero();
  return 0.5 * (floor->edge_u + floor->edge_v).head<2>().cwiseAbs();
}

// The largest distance of a corner from the plane of `face`, on its visible side, metres.
double LargestHeight(const Quad& quad, const Quad& face) {
  double largest = (quad.origin - face.origin).dot(face.Normal());
  for (const int corner : {1, 2, 3}) {
    const Eigen::Vector3d x = quad.At(corner & 1, corner >> 1);
    largest = std::max(largest, (x - face.origin).dot(face.Normal()));
  }
  return largest;
}

Quad Rectangle(const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
               const Eigen::Vector3d& edge_v) {
  Quad quad;
  quad.origin = origin;
  quad.edge_u = edge_u;
  quad.edge_v = edge_v;
  return quad;
}

}  // namespace

void AddSpecularSurfaces(const SpecularOptions& options, Scene* room) {
  const Eigen::Vector2d half = HalfSize(*room);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3f black(0.03f, 0.03f, 0.03f);
  const auto add = [room](const Quad& face, double reflectance, double transmittance) {
    room->specular.push_back({face, reflectance, transmittance, Eigen::Vector3f::Zero()});
  };
  // Surfaces that may be seen through others come first. Glass reflects 4 % of the light at each
  // side when seen from the front, and polished surfaces, seen at an angle, a quarter.
  if (options.floor) {
    add(Rectangle({-half.x(), -half.y(), 0.012}, {2.0 * half.x(), 0, 0}, {0, 2.0 * half.y(), 0}),
        0.25, 0.75);
  }
  if (options.mirror) {
    add(Rectangle({1.25, half.y() - 0.05, 0.5}, {1.5, 0, 0}, 1.6 * up), 0.9, 0.0);
  }
  if (options.screen) {
    add(Rectangle({1.22, 0.06 - half.y(), 0.9}, {-0.65, 0, 0}, up), 0.25, 0.0);
    room->specular.back().color = black;
  }
  if (options.glass) {
    add(Rectangle({half.x() - 0.15, 1.2, 1.15}, {0, -2.1, 0}, 0.95 * up), 0.05, 0.92);
  }
}

Scene MirrorImage(const Scene& scene, const Quad& face) {
  const Eigen::Vector3d normal = face.Normal();
  const Placement reflection{Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose(),
                             2.0 * normal.dot(face.origin) * normal};
  Scene front = scene;
  front.quads.clear();
  for (const Quad& quad : scene.quads) {
    if (LargestHeight(quad, face) > kWallDistance) front.quads.push_back(quad);
  }
  Scene mirrored;
  mirrored.ambient = scene.ambient;
  mirrored.daylight = reflection.linear.cast<float>() * scene.daylight;
  AddCopy(front, reflection, 0, &mirrored);
  return mirrored;
}

}  // namespace msc_vo
