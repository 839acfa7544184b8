// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// L_j = {S_j, E_j} of the paper.
struct LineLandmark : Landmark {
  using Feature = LineFeature;
  using Geometry = LineSegment3;

  static constexpr const char* kName = "line";
  /// As for points: with its depth a line constrains four of the six degrees of freedom of a pose,
  /// and the pixel of a point two.
  static constexpr int kSupport = 2;

  LineSegment3 segment;  ///< metres, world
  /// Standard deviation (radians) of the direction's least certain component in the best single
  /// view; pi if no view has a depth.
  double direction_sigma = 0.0;
  /// Common error (metres) of its measured depths in all views; positive: measured too far.
  double depth_offset = 0.0;

  const Geometry& geometry() const { return segment; }
  void SetGeometry(const Geometry& geometry) { segment = geometry; }
  /// The point that stands for its place, metres, world.
  Eigen::Vector3d Center() const { return segment.Midpoint(); }
  /// Expresses the landmark in another world.
  void Transform(const Rigid3& new_from_old_world) {
    segment = new_from_old_world * segment;
    viewing_direction = new_from_old_world.rotation() * viewing_direction;
  }
  /// Geometry of a feature that has a depth, metres, camera.
  static Geometry InCamera(const Frame& frame, int feature) { return frame.LineInCamera(feature); }

  /// As for points: viewing direction and sigma of the direction.
  template <typename Keyframes>
  void RefreshViews(const Keyframes& keyframes) {
    Eigen::Vector3d directions = Eigen::Vector3d::Zero();
    direction_sigma = kPi;
    for (const Observation& observation : observations) {
      const auto& keyframe = *keyframes.Find(observation.keyframe);
      const Feature& feature = keyframe.frame->lines[observation.feature];
      if (feature.depth) {
        direction_sigma =
            std::min(direction_sigma,
                     DirectionSigma(keyframe.frame->camera, feature.segment, *feature.depth));
      }
      directions += (segment.Midpoint() - keyframe.cam_from_world.OriginInSource()).normalized();
    }
    viewing_direction = directions.normalized();
  }
  /// As for points.
  const char* GeometryViolation() const {
    if (!segment.start.allFinite() || !segment.end.allFinite()) {
      return "its end points are not finite";
    }
    if (!(segment.Length() > 0.0)) return "it has no length";
    if (!std::isfinite(depth_offset)) return "its depth offset is not finite";
    const bool has_sigma = std::isfinite(direction_sigma) && direction_sigma > 0.0;
    return has_sigma ? nullptr : "the sigma of its direction is not positive";
  }

  /// Always: the depth of a line has an offset of its own.
  bool AgreesWithDepth(const Rigid3& /*cam_from_world*/, const Feature& /*measured*/) const {
    return true;
  }
  /// As for points: if the angle between the two lines (radians) and the distance of each midpoint
  /// from the other line, relative to the distance from the camera, are small.
  static bool AreDuplicates(const Eigen::Vector3d& center, const LineLandmark& line_a,
                            const LineLandmark& line_b) {
    constexpr double kMaxAngle = DegreesToRadians(5.0);
    constexpr double kMaxOffset = 0.02;
    const LineSegment3 &a = line_a.segment, &b = line_b.segment;
    if (UndirectedAngle(a.Direction(), b.Direction()) > kMaxAngle) return false;
    return std::max(a.DistanceToLine(b.Midpoint()), b.DistanceToLine(a.Midpoint())) <
           kMaxOffset * (a.Midpoint() - center).norm();
  }
  /// Always: lines have no levels.
  static bool IsAsFine(const Feature& /*other*/, const Feature& /*feature*/) { return true; }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(static_cast<Landmark&>(*this), segment, direction_sigma, depth_offset);
  }
};

}  // namespace msc_vo
