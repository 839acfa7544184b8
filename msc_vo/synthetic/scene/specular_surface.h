// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace msc_vo {

struct Quad;
struct Scene;

/// Surfaces whose image shows something that is not at their depth: a depth camera measures the
/// pane, the colour camera sees what is behind it or the mirror image of the room.
struct SpecularOptions {
  bool mirror = false;  ///< a mirror of 1.5 x 1.6 m on a wall
  bool glass = false;   ///< a pane of 2.1 x 0.95 m, 0.15 m in front of the pictures of a wall
  bool floor = false;   ///< the whole floor is polished and reflects a quarter of the light
  bool screen = false;  ///< a black screen of 0.65 x 1 m that reflects a quarter of the light

  bool Any() const { return mirror || glass || floor || screen; }
};

/// Adds the surfaces to a scene of the kind kRoom.
void AddSpecularSurfaces(const SpecularOptions& options, Scene* room);

/// The mirror image of a scene behind the plane of `face`, without its specular surfaces: what a
/// mirror shows. Rectangles behind the plane are left out.
Scene MirrorImage(const Scene& scene, const Quad& face);

}  // namespace msc_vo
