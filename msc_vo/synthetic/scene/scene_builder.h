// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

// Puts walls and boxes into a scene.
class SceneBuilder {
 public:
  explicit SceneBuilder(uint64_t seed) : random_(seed) {}

  Scene& scene() { return scene_; }
  Random& random() { return random_; }

  // A texture with a seed of its own.
  Texture NewTexture(TextureKind kind, const Eigen::Vector3f& color,
                     const Eigen::Vector3f& accent = {0.3f, 0.3f, 0.3f}, float scale = 1.0f);

  // A rectangle, its visible side where edge_u x edge_v points; its border joins the edges.
  void AddQuad(const Quad& quad);

  // The box [low, high] of a frame, seen from outside. `front`, if given, covers the face that
  // looks along the frame's +y.
  void AddBox(const Rigid3& world_from_frame, const Eigen::Vector3d& low,
              const Eigen::Vector3d& high, const Texture& texture, const Texture* front = nullptr);

  // The inside of the box [low, high] in the world: floor, ceiling and four walls alike.
  void AddHall(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Texture& floor,
               const Texture& ceiling, const Texture& walls);

  void AddWaypoint(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
    scene_.tour.push_back({position, target});
  }

 private:
  void AddBoxEdges(const Rigid3& world_from_frame, const Eigen::Vector3d& low,
                   const Eigen::Vector3d& high);

  Scene scene_;
  Random random_;
};

// The frame at `origin` whose +y looks along `facing` (radians about z; 0: along world +y).
Rigid3 UprightFrame(const Eigen::Vector3d& origin, double facing);

}  // namespace msc_vo
