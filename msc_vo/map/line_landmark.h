// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// L_j = {S_j, E_j} of the paper.
struct LineLandmark : Landmark {
  using Feature = LineFeature;
  using Geometry = LineSegment3;

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
  static bool HasDepth(const Feature& feature) { return feature.depth.has_value(); }
  /// Geometry of a feature that has a depth, metres, camera.
  static Geometry InCamera(const Frame& frame, int feature) { return frame.LineInCamera(feature); }

  template <typename Archive>
  void Serialize(Archive& archive) {
    Landmark::Serialize(archive);
    archive(segment, direction_sigma, depth_offset);
  }
};

}  // namespace msc_vo
