// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "msc_vo/geometry/convex_polygon.h"
#include "msc_vo/geometry/plane_extent.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// A plane of a depth image. With a ray b = (x / z, y / z, 1) of the undistorted camera, the
/// inverse depth on a plane {x : n . x + d = 0} is linear, 1 / z = q . b with q = -n / d: q is
/// the plane as the sensor measures it, whose noise is that of inverse depth.
struct PlaneFeature {
  Eigen::Vector3d inverse_depth = Eigen::Vector3d::Zero();  ///< q, 1/metres
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();     ///< of q, 1/metres^2
  /// Mean of b b^T over its pixels: (p - q)^T M (p - q) is the mean squared difference in inverse
  /// depth between two planes where this one was seen.
  Eigen::Matrix3d mean_square_ray = Eigen::Matrix3d::Zero();
  int num_pixels = 0;
  /// Convex hull of its pixels as rays (x / z, y / z), kMaxHullVertices or fewer; empty if the
  /// extent is unknown.
  ConvexPolygon hull = {};

  static constexpr size_t kMaxHullVertices = 12;
  static constexpr double kMinInverseDepth = 0.02;  ///< of a vertex of Extent(), 1/metres

  /// Unit normal towards the camera, and the distance of the camera from the plane, metres.
  Eigen::Vector3d Normal() const { return -inverse_depth.normalized(); }
  double Distance() const { return 1.0 / inverse_depth.norm(); }
  /// The hull on the plane, camera frame, metres. A hull that reaches beyond the measured pixels to
  /// the horizon of the plane is clipped at kMinInverseDepth. Empty if the hull is, or if nothing
  /// of it is near enough.
  PlaneExtent Extent() const;

  /// Changes the camera frame of the plane, but of neither covariance nor extent, which hardly
  /// change in small motions. Keeps a plane whose distance would change by more than half, as by
  /// the velocity of a wrong pose.
  void Move(const Rigid3& new_from_old);
  /// Adds the noise of an unknown motion of the camera: standard deviations of its rotation vector
  /// (radians) and of its translation (metres).
  void AddMotionNoise(double rotation_sigma, double translation_sigma);
};

}  // namespace msc_vo
