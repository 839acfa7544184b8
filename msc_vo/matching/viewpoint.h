// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// Cosine of the largest viewing-angle difference, 60 degrees: beyond it ORB descriptors change.
constexpr double kMinViewingCosine = 0.5;

/// A frame at a pose, which landmarks of the map are expected to be visible from.
struct Viewpoint {
  Viewpoint(const Frame& frame_in, const Rigid3& cam_from_world_in);

  const Frame& frame;
  Rigid3 cam_from_world;
  Eigen::Vector3d center;  ///< of the camera, metres, world
  /// Lowest and highest pyramid level that the frame may have point features of; points that are
  /// farther or nearer cannot be matched.
  int lowest_level;
  int highest_level;

  /// Whether the ray (metres, world) from the camera to a landmark is close to its mean viewing
  /// direction.
  static bool HasSimilarAngle(const Landmark& landmark, const Eigen::Vector3d& ray) {
    return landmark.viewing_direction.dot(ray) >= kMinViewingCosine * ray.norm();
  }
};

}  // namespace msc_vo
