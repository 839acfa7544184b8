// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// Adds walls and boxes to a scene, and their edges.
class SceneBuilder {
 public:
  /// The streams of one seed are independent.
  explicit SceneBuilder(uint64_t seed, uint64_t stream = 0) : random_(seed, stream) {}

  Scene& scene() { return scene_; }
  Random& random() { return random_; }

  /// Returns a texture with a new seed.
  Texture NewTexture(TextureKind kind, const Eigen::Vector3f& color,
                     const Eigen::Vector3f& accent = {0.3f, 0.3f, 0.3f}, float scale = 1.0f);

  /// Adds a rectangle and its border to the edges.
  void AddQuad(const Quad& quad);

  /// Adds the box [low, high] in a frame, visible from outside. `front`, if given, is the texture
  /// of the face with normal +y in the frame.
  void AddBox(const Rigid3& world_from_frame, const Eigen::Vector3d& low,
              const Eigen::Vector3d& high, const Texture& texture, const Texture* front = nullptr);

  /// Adds the inside of the box [low, high] in the world frame: floor, ceiling and four walls.
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

/// World-from-frame transform with the given origin and z up, whose +y axis is the world's +y axis
/// rotated by `facing` about z, radians.
Rigid3 UprightFrame(const Eigen::Vector3d& origin, double facing);

}  // namespace msc_vo
