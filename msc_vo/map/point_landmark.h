// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
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

  static constexpr const char* kName = "point";
  /// Number of points that it counts as, as support of a pose.
  static constexpr int kSupport = 1;

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
  /// Geometry of a feature that has a depth, metres, camera.
  static Geometry InCamera(const Frame& frame, int feature) { return frame.PointInCamera(feature); }

  /// Recomputes what depends on the views: viewing direction and reference distance. `keyframes` is
  /// the table of keyframes.
  template <typename Keyframes>
  void RefreshViews(const Keyframes& keyframes) {
    Eigen::Vector3d directions = Eigen::Vector3d::Zero();
    double log_reference = 0.0;
    for (const Observation& observation : observations) {
      const auto& keyframe = *keyframes.Find(observation.keyframe);
      const Feature& feature = keyframe.frame->points[observation.feature];
      const Eigen::Vector3d ray = position - keyframe.cam_from_world.OriginInSource();
      directions += ray.normalized();
      log_reference +=
          std::log(std::max(ray.norm(), 1e-6)) + feature.level * std::log(kPyramidScale);
    }
    viewing_direction = directions.normalized();
    reference_distance = std::exp(log_reference / observations.size());
  }
  /// Describes what its geometry violates; nullptr if nothing (FirstViolation).
  const char* GeometryViolation() const {
    if (!position.allFinite()) return "its position is not finite";
    const bool has_distance = std::isfinite(reference_distance) && reference_distance > 0.0;
    return has_distance ? nullptr : "its reference distance is not positive";
  }

  /// Whether the depth of a feature of a keyframe, if it was measured, agrees with the landmark, at
  /// the 99 % quantile.
  bool AgreesWithDepth(const Rigid3& cam_from_world, const Feature& measured) const {
    if (!measured.HasDepth() || has_false_depth) return true;
    const double depth = (cam_from_world * position).z();
    return depth > 0.0 &&
           std::abs(1.0 / depth - measured.inverse_depth) < 2.576 * measured.inverse_depth_sigma;
  }
  /// Whether two landmarks that a feature of a camera at `center` (world) was matched with are one.
  static bool AreDuplicates(const Eigen::Vector3d& /*center*/, const PointLandmark& /*a*/,
                            const PointLandmark& /*b*/) {
    return true;  // both project to the feature, at its depth unless that is false
  }
  /// Whether an observation is as fine as a feature: its level is at most one coarser.
  static bool IsAsFine(const Feature& other, const Feature& feature) {
    return other.level <= feature.level + 1;
  }

  /// Pyramid level, not rounded, at which the point is expected from `distance` metres.
  double PredictLevel(double distance) const {
    return std::log(reference_distance / distance) / std::log(kPyramidScale);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(static_cast<Landmark&>(*this), position, reference_distance);
  }
};

}  // namespace msc_vo
