// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

#include <Eigen/Core>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// P_i of the paper.
struct PointLandmark : Landmark {
  using Feature = PointFeature;
  using Geometry = Eigen::Vector3d;

  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  /// Distance (metres) at which the point's patch has the size of pyramid level 0.
  double reference_distance = 0.0;

  const Geometry& geometry() const { return position; }
  void SetGeometry(const Geometry& geometry) { position = geometry; }
  /// The point that stands for its place, metres, world.
  const Eigen::Vector3d& Center() const { return position; }
  /// Expresses the landmark in another world.
  void Transform(const Rigid3& new_from_old_world) {
    position = new_from_old_world * position;
    viewing_direction = new_from_old_world.rotation() * viewing_direction;
  }
  static bool HasDepth(const Feature& feature) { return feature.HasDepth(); }
  /// Geometry of a feature that has a depth, metres, camera.
  static Geometry InCamera(const Frame& frame, int feature) { return frame.PointInCamera(feature); }

  /// Pyramid level, not rounded, at which the point is expected from `distance` metres.
  double PredictLevel(double distance) const {
    return std::log(reference_distance / distance) / std::log(kPyramidScale);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    Landmark::Serialize(archive);
    archive(position, reference_distance);
  }
};

}  // namespace msc_vo
